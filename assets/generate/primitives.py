#!/usr/bin/env python3
"""Makes assets/models/primitives.glb and assets/scenes/primitives.json, a small scene for tests. Needs numpy, Pillow."""

import numpy as np

import demo_layout as layout
import tidy_json
from glb import Glb
from noise import to_srgb
from shapes import box, lathe, sphere, tube


def checker():
    y, x = np.mgrid[0:64, 0:64] // 8
    dark, light = np.array([0.05, 0.08, 0.30]), np.array([0.85, 0.80, 0.65])
    return to_srgb(np.where(((x + y) % 2 == 0)[..., None], dark, light))


def plain(surface):
    surface.uvs = surface.tangents = None
    return surface


def main():
    glb = Glb("assets/generate/primitives.py")
    glb.json["samplers"] = [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}]
    checkered = glb.material("checker", roughness=0.8, base=glb.texture(checker(), "checker", 90))
    red = glb.material("red", (0.75, 0.06, 0.04, 1), roughness=0.5)
    mirror = glb.material("mirror", (0.95, 0.95, 0.95, 1), metallic=1.0, roughness=0.0)
    gold = glb.material("gold", (1.0, 0.72, 0.32, 1), metallic=1.0, roughness=0.3)
    glass = glb.material("glass", (0.2, 0.6, 0.8, 0.4), roughness=0.1, alphaMode="BLEND", doubleSided=True)
    green = glb.material("green", (0.08, 0.45, 0.12, 1), roughness=0.9)

    cube = glb.mesh("cube", [glb.primitive(box((0.3, 0.3, 0.3)), checkered)])
    glb.node("checkered cube", cube, translation=[-0.45, 0.15, 0.0], rotation=[0, 0.25881905, 0, 0.96592583])
    glb.node("small cube", cube, translation=[-0.45, 0.36, 0.0], scale=[0.4, 0.4, 0.4])
    glb.node(
        "red ball",
        glb.mesh("red ball", [glb.primitive(plain(sphere(0.16, 32, 20)), red)]),
        translation=[0.0, 0.16, 0.15],
    )
    glb.node(
        "mirror ball",
        glb.mesh("mirror ball", [glb.primitive(plain(sphere(0.2, 40, 24)), mirror)]),
        translation=[0.42, 0.2, -0.05],
    )
    angle = np.linspace(0, 2 * np.pi, 33)[:-1]
    path = np.stack([0.14 * np.cos(angle), 0.14 * np.sin(angle), 0 * angle], 1)
    glb.node(
        "gold ring",
        glb.mesh("gold ring", [glb.primitive(plain(tube(path, 0.035, 12)), gold)]),
        translation=[0.0, 0.175, -0.3],
    )
    cone = lathe([(0.002, 0.35), (0.07, 0.175), (0.14, 0.0), (0.002, 0.0)], 24)
    glb.node("green cone", glb.mesh("green cone", [glb.primitive(plain(cone), green)]), translation=[0.78, 0.0, 0.1])
    glb.node(
        "glass pane",
        glb.mesh("glass pane", [glb.primitive(plain(box((0.25, 0.4, 0.01))), glass)]),
        translation=[-0.2, 0.2, 0.3],
    )
    glb.write(layout.ASSETS / "models" / "primitives.glb")

    scene = {
        "format": "foveray-scene",
        "version": 1,
        "name": "primitives",
        "models": [
            {"name": "primitives", "file": "../models/primitives.glb", "transform": {"translation": [0, 0, -1.5]}}
        ],
        "lights": [
            {"type": "directional", "direction": [0.5, -1, -0.4], "intensity": 1.5},
            {
                "type": "area",
                "name": "lamp",
                "center": [-0.6, 2.2, -1.0],
                "half_u": [0.35, 0, 0],
                "half_v": [0, 0, 0.35],
                "intensity": 10,
            },
        ],
        "environment": {"color": [0.35, 0.4, 0.5]},
        "real_surfaces": [
            {"type": "plane", "name": "floor", "center": [0, 0, -1.5], "normal": [0, 1, 0], "half_size": [3, 3]},
        ],
        "camera": {"position": [0, 1.5, 0.3], "look_at": [0.1, 0.15, -1.5], "vertical_fov_degrees": 50},
    }
    tidy_json.write(layout.ASSETS / "scenes" / "primitives.json", scene)


if __name__ == "__main__":
    main()
