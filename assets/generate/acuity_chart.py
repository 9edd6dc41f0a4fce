"""The acuity chart of HERR's figure 8: assets/scenes/acuity_chart.json. Gratings on a sphere round the seat, finer
towards its middle as the eye is: on two axes of each ring a quarter of the acuity's pixels a degree, which the eye
sees there, on the two between three quarters, which must look grey."""

import math
import pathlib

import tidy_json

EYE = 1.2  # metres over the floor, seated
DISTANCE = 2.0
RING_DISTANCE = 2.04  # behind the gratings
RINGS = [5, 10, 20, 30, 40]
ACUITY = {"a": 200, "b": 1, "cap_ppd": 60}  # of varjo-xr1
GREY = [0.5, 0.5, 0.5]  # the gratings' mean
INK = [0.06, 0.10, 0.16]


def unlit(color):
    return {"base_color": color, "unlit": True}


def patches(frequency, meridians, middle):
    points = [[0, 0, 0]] if middle else []
    points += [[e, m, turn] for e in RINGS for m, turn in meridians]
    return {
        "kind": "acuity_patches",
        "pattern": "sine",
        "parameters": {"distance": DISTANCE, **ACUITY, "frequency": frequency, "periods": 10},
        "points": points,
        "material": unlit([1, 1, 1]),
    }


def at(eccentricity, meridian):
    e, m = math.radians(eccentricity), math.radians(meridian)
    return [round(DISTANCE * x, 5) for x in (math.sin(e) * math.cos(m), math.sin(e) * math.sin(m), -math.cos(e))]


def ring(eccentricity):
    e = math.radians(eccentricity)
    return {
        "kind": "torus_knot",
        "parameters": {
            "turns": 1, "windings": 0, "radius": round(RING_DISTANCE * math.sin(e), 5),
            "tube_radius": round(0.0001 * RING_DISTANCE * (eccentricity + 1), 6), "segments": 6, "rings": 256,
        },
        "material": unlit(INK),
        "transform": {"euler_degrees": [90, 0, 0], "translation": [0, 0, round(-RING_DISTANCE * math.cos(e), 5)]},
    }


def label(eccentricity, meridian):
    x, y, z = at(eccentricity * 1.1, meridian)
    yaw = math.degrees(math.atan2(-x, -z))
    pitch = math.degrees(math.asin(y / DISTANCE))
    return {
        "kind": "digits",
        "parameters": {"value": eccentricity, "height": round(0.002 * DISTANCE * (eccentricity + 1), 5)},
        "material": unlit(INK),
        "transform": {"translation": [x, y, z], "euler_degrees": [round(pitch, 4), round(yaw, 4), 0]},
    }


def chart_object(name, parts):
    return {"name": name, "mesh": parts, "transform": {"translation": [0, EYE, 0]}}


tidy_json.write(
    pathlib.Path(__file__).parent.parent / "scenes" / "acuity_chart.json",
    {
        "format": "foveray-scene",
        "version": 1,
        "name": "acuity chart: what is seen at 5, 10, 20, 30 and 40 degrees from the gaze, and what must not be",
        "objects": [
            chart_object("gratings that are seen", [patches(0.25, [(0, 0), (180, 0), (90, 90), (270, 90)], True)]),
            chart_object("gratings too fine", [patches(0.75, [(45, 0), (225, 0), (135, 90), (315, 90)], False)]),
            chart_object("rings and degrees",
                         [ring(e) for e in RINGS] + [label(e, m) for e in RINGS for m in (22.5, 157.5)]),
            chart_object("backdrop", [{
                "kind": "boulder",
                "parameters": {"radius": 2.5, "relief": 0, "facets": 0, "subdivisions": 12},
                "material": unlit(GREY),
            }]),
        ],
        "camera": {"position": [0, EYE, 0], "look_at": [0, EYE, -1], "vertical_fov_degrees": 90},
    },
)
