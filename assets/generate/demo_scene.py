#!/usr/bin/env python3
"""Writes assets/scenes/demo.json and assets/feeds/demo.calibration.json from demo_layout. Plain Python."""

import demo_layout as layout
import tidy_json

OAK = [0.27, 0.17, 0.09]
PLASTER = [0.76, 0.73, 0.68]


def rounded(values):
    return [round(v, 4) for v in values]


def model(name, at, turn=0.0):
    transform = {"translation": list(at)}
    if turn:
        transform["euler_degrees"] = [0, turn, 0]
    return {"name": name, "file": f"../models/{name}.glb", "transform": transform}


def wall(name, centre, normal, half_size, albedo=PLASTER, **more):
    return {
        "type": "plane",
        "name": name,
        "center": rounded(centre),
        "normal": rounded(normal),
        "half_size": rounded(half_size),
        "albedo": albedo,
        **more,
    }


def scene():
    along, normal, length = layout.slope_frame()
    x0, x1 = layout.ROOM_X
    z0, z1 = layout.ROOM_Z
    knee, top = layout.KNEE_WALL_HEIGHT, layout.CEILING_HEIGHT
    mid_z, half_z = (z0 + z1) / 2, (z1 - z0) / 2
    low, high = layout.TABLE_TOP
    red = layout.WINDOW_RADIANCE[0]
    return {
        "format": "foveray-scene",
        "version": 1,
        "name": "a cloisonné vase in an attic room",
        "models": [
            model("cloisonne_vase", layout.VASE),
            model("chrome_sphere", layout.SPHERE),
            model("torus_knot", layout.KNOT, 28),
            model("glass_float", layout.FLOAT, 17),
            model("succulent", layout.POT),
        ],
        "lights": [
            {
                "type": "area",
                "name": "roof window",
                "center": rounded(layout.window_pane()),
                "half_u": rounded(a * layout.WINDOW_ALONG / 2 for a in along),
                "half_v": [0, 0, layout.WINDOW_ACROSS / 2],
                "color": rounded(c / red for c in layout.WINDOW_RADIANCE),
                "intensity": red,
            }
        ],
        "environment": {"file": "../environments/demo_room.hdr"},
        "real_surfaces": [
            wall("floor", ((x0 + x1) / 2, 0, mid_z), (0, 1, 0), ((x1 - x0) / 2, half_z), OAK, u_axis=[1, 0, 0]),
            {
                "type": "box",
                "name": "side table top",
                "pose": {"position": rounded((a + b) / 2 for a, b in zip(low, high))},
                "half_size": rounded((b - a) / 2 for a, b in zip(low, high)),
                "albedo": [0.34, 0.22, 0.12],
            },
            wall(
                "back wall",
                ((x0 + x1) / 2, top / 2, z0),
                (0, 0, 1),
                ((x1 - x0) / 2, top / 2),
                [0.30, 0.36, 0.30],
                u_axis=[1, 0, 0],
            ),
            wall("knee wall", (x0, knee / 2, mid_z), (1, 0, 0), (half_z, knee / 2), u_axis=[0, 0, -1]),
            wall("right wall", (x1, top / 2, mid_z), (-1, 0, 0), (half_z, top / 2), u_axis=[0, 0, 1]),
        ],
        "camera": {"position": [0.05, 1.52, 0.15], "look_at": [-0.1, 0.62, -1.4], "vertical_fov_degrees": 62},
    }


def calibration():
    width, height = layout.CAMERA_WIDTH, layout.CAMERA_HEIGHT
    return {
        "format": "foveray-calibration",
        "version": 1,
        "model": "fisheye",
        "width": width,
        "height": height,
        "fx": layout.CAMERA_FOCAL,
        "fy": layout.CAMERA_FOCAL,
        "cx": (width - 1) / 2,
        "cy": (height - 1) / 2,
        "distortion": [0, 0, 0, 0],
        "head_from_camera": {"position": list(layout.CAMERA_FROM_HEAD_OFFSET), "orientation": [0, 0, 0, 1]},
        "latency_ms": 0,
    }


if __name__ == "__main__":
    tidy_json.write(layout.ASSETS / "scenes" / "demo.json", scene())
    tidy_json.write(layout.ASSETS / "feeds" / "demo.calibration.json", calibration())
