#!/usr/bin/env python3
"""Makes the demo's models, assets/models/*.glb. Needs python3-numpy, python3-pil and python3-cairo (Debian).

/usr/bin/python3 assets/generate/demo_models.py [vase|knot|sphere|float|succulent]…
"""

import sys

import numpy as np

import demo_layout as layout
import enamel
import wood
from glb import Glb
from noise import fractal, mix, normal_map, random, smoothstep, to_srgb
from shapes import (
    Surface,
    bezier_profile,
    grid_triangles,
    joined,
    lathe,
    normalized,
    resampled,
    sphere,
    tube,
    without_slivers,
)

MODELS = layout.ASSETS / "models"
GENERATOR = "assets/generate/demo_models.py"
GOLD = (1.0, 0.72, 0.32, 1.0)

STAND_HEIGHT = 0.56
VASE_OUTSIDE = [
    (0.078, 0.522), (0.084, 0.522), (0.086, 0.517), (0.083, 0.511), (0.072, 0.495), (0.052, 0.480), (0.051, 0.448),
    (0.050, 0.420), (0.075, 0.405), (0.110, 0.385), (0.150, 0.362), (0.168, 0.325), (0.166, 0.280), (0.163, 0.210),
    (0.110, 0.130), (0.085, 0.060), (0.078, 0.035), (0.080, 0.022), (0.092, 0.010), (0.095, 0.006), (0.095, 0.002),
    (0.092, 0.000),
]  # fmt: skip
VASE_INSIDE = [
    (0.002, 0.180), (0.080, 0.180), (0.150, 0.230), (0.155, 0.290), (0.158, 0.330), (0.140, 0.355), (0.100, 0.377),
    (0.068, 0.395), (0.043, 0.420), (0.044, 0.446), (0.045, 0.474), (0.056, 0.487), (0.067, 0.503), (0.070, 0.512),
    (0.073, 0.522), (0.078, 0.522),
]  # fmt: skip
STAND = [
    (0.003, 0.560), (0.060, 0.560), (0.110, 0.560), (0.158, 0.560), (0.166, 0.560), (0.171, 0.555), (0.171, 0.548),
    (0.171, 0.541), (0.166, 0.537), (0.160, 0.536), (0.154, 0.535), (0.156, 0.530), (0.160, 0.526), (0.164, 0.520),
    (0.162, 0.512), (0.150, 0.508), (0.110, 0.500), (0.060, 0.490), (0.050, 0.455), (0.049, 0.452), (0.049, 0.449),
    (0.054, 0.446), (0.066, 0.440), (0.066, 0.424), (0.054, 0.418), (0.048, 0.415), (0.047, 0.412), (0.046, 0.408),
    (0.044, 0.380), (0.052, 0.350), (0.066, 0.310), (0.084, 0.262), (0.090, 0.205), (0.062, 0.172), (0.050, 0.158),
    (0.050, 0.154), (0.053, 0.151), (0.064, 0.146), (0.074, 0.142), (0.074, 0.126), (0.064, 0.122), (0.056, 0.119),
    (0.054, 0.116), (0.056, 0.112), (0.066, 0.088), (0.105, 0.076), (0.150, 0.066), (0.165, 0.062), (0.172, 0.060),
    (0.176, 0.054), (0.178, 0.050), (0.180, 0.046), (0.186, 0.046), (0.200, 0.045), (0.206, 0.036), (0.206, 0.022),
    (0.206, 0.010), (0.202, 0.000), (0.196, 0.000), (0.190, 0.000), (0.188, 0.000),
]  # fmt: skip


def vase():
    glb = Glb(GENERATOR)
    base, normal, surface = enamel.paint()
    cloisonne = glb.material(
        "cloisonne",
        metallic=1.0,
        base=glb.texture(base, "cloisonne base colour", 91),
        normal=glb.texture(normal, "cloisonne normal", 93),
        surface=glb.texture(surface, "cloisonne metallic-roughness", 88),
    )
    outside, _ = resampled(bezier_profile(VASE_OUTSIDE, 60), 84)
    inside, _ = resampled(bezier_profile(VASE_INSIDE, 30), 24)
    glaze = glb.material("turquoise glaze", (0.03, 0.30, 0.33, 1.0), roughness=0.2)
    up = (0.0, STAND_HEIGHT, 0.0)
    body = lathe(outside, 160, 2.0).moved(up)
    lining = lathe(inside, 64).moved(up)
    lining.uvs = lining.tangents = None
    glb.node("vase", glb.mesh("vase", [glb.primitive(body, cloisonne), glb.primitive(lining, glaze)]))

    profile, length = resampled(bezier_profile(STAND, 24), 136)
    base, normal, surface = wood.turned(profile, length, 1024, wood.WALNUT, 5, heart=(-0.17, -0.34))
    walnut = glb.material(
        "walnut",
        base=glb.texture(base, "walnut base colour", 89),
        normal=glb.texture(normal, "walnut normal", 88),
        surface=glb.texture(surface, "walnut metallic-roughness", 85),
    )
    glb.node("stand", glb.mesh("stand", [glb.primitive(lathe(profile, 80), walnut)]))
    glb.write(MODELS / "cloisonne_vase.glb")


def chrome_sphere():
    glb = Glb(GENERATOR)
    chrome = glb.material("chrome", (0.90, 0.91, 0.92, 1.0), metallic=1.0, roughness=0.0)
    brass = glb.material("brass", (0.86, 0.62, 0.26, 1.0), metallic=1.0, roughness=0.28)
    ball = sphere(layout.SPHERE_RADIUS, 112, 64).moved((0, layout.SPHERE_RADIUS + 0.004, 0))
    ball.uvs = ball.tangents = None
    angle = np.linspace(0, 2 * np.pi, 97)[:-1]
    ring = tube(np.stack([0.105 * np.sin(angle), 0.013 + 0 * angle, 0.105 * np.cos(angle)], 1), 0.013, 10)
    ring.uvs = None
    glb.node("gazing ball", glb.mesh("gazing ball", [glb.primitive(ball, chrome), glb.primitive(ring, brass)]))
    glb.write(MODELS / "chrome_sphere.glb")


def brushed_normal(size, seed):
    """Fine scratches along the tube, and hammer marks."""
    v, u = (np.mgrid[0:size, 0:size] + 0.5) / size
    scratches = fractal(u * 96, v * 10, octaves=3, seed=seed, period_x=96)
    return 0.000010 * scratches, 0.05 * scratches


def torus_knot():
    glb = Glb(GENERATOR)
    size = 512
    relief, gloss = brushed_normal(size, 3)
    normal = glb.texture(normal_map(relief, 0.20 / size, 0.20 / size), "brushed normal", 90)
    surface = np.stack([np.ones((size, size)), np.clip(0.24 + gloss, 0.08, 1), np.ones((size, size))], -1)
    brass = glb.material(
        "brushed gold",
        GOLD,
        metallic=1.0,
        normal=normal,
        surface=glb.texture(surface, "brushed metallic-roughness", 88),
    )
    marble_base = marble(512, 8)
    marble_material = glb.material(
        "black marble", roughness=0.25, base=glb.texture(marble_base, "black marble base colour", 88)
    )
    t = np.linspace(0, 2 * np.pi, 321)[:-1]
    p, q = 2, 3
    r = 0.092 + 0.036 * np.cos(q * t)
    path = np.stack([r * np.cos(p * t), r * np.sin(p * t), 0.046 * np.sin(q * t)], 1)
    knot = tube(path, 0.0195, 22)
    knot.uvs = knot.uvs * np.array([1.0, 12.0])
    knot.tangents = None
    lowest = knot.positions[:, 1].min()
    knot = knot.moved((0, 0.042 - lowest - 0.003, 0))
    profile = bezier_profile(
        [(0.002, 0.042), (0.03, 0.042), (0.06, 0.042), (0.076, 0.042), (0.082, 0.042), (0.084, 0.040), (0.084, 0.036),
         (0.084, 0.026), (0.086, 0.014), (0.094, 0.008), (0.096, 0.006), (0.096, 0.002), (0.096, 0.0)], 12)  # fmt: skip
    foot = lathe(profile, 72)
    foot.uvs = foot.positions[:, [0, 2]] * 4 + foot.positions[:, [1, 1]] * 4
    foot.tangents = None
    glb.node("knot", glb.mesh("torus knot", [glb.primitive(knot, brass), glb.primitive(foot, marble_material)]))
    glb.write(MODELS / "torus_knot.glb")


def marble(size, seed):
    v, u = (np.mgrid[0:size, 0:size] + 0.5) / size
    warp = fractal(u * 4, v * 4, octaves=5, seed=seed, period_x=4)
    veins = 1 - np.abs(fractal(u * 3 + 0, v * 3 + 0.9 * warp, octaves=4, seed=seed + 20, period_x=3))
    vein = smoothstep(0.93, 1.0, veins)
    base = np.array([0.012, 0.013, 0.016]) * (1 + 0.5 * warp)[..., None]
    return to_srgb(mix(base, np.array([0.55, 0.52, 0.46]), 0.8 * vein[..., None]))


def glass_float():
    """A fisher's glass float in a net of rope."""
    glb = Glb(GENERATOR)
    radius = layout.FLOAT_RADIUS
    glass = glb.material("sea glass", (0.10, 0.52, 0.40, 0.38), roughness=0.03, alphaMode="BLEND", doubleSided=True)
    size = 256
    v, u = (np.mgrid[0:size, 0:size] + 0.5) / size
    strand = np.abs(np.modf(u * 3 + v * 2)[0] - 0.5) * 2
    relief = 0.0012 * np.sqrt(np.clip(1 - strand**2, 0, 1)) + 0.0001 * fractal(
        u * 40, v * 20, octaves=2, seed=4, period_x=40
    )
    hemp = (
        np.array([0.48, 0.34, 0.18])
        * (
            0.55
            + 0.45 * np.sqrt(np.clip(1 - strand**2, 0, 1))
            + 0.12 * fractal(u * 64, v * 16, octaves=3, seed=6, period_x=64)
        )[..., None]
    )
    rope = glb.material(
        "hemp rope",
        roughness=0.9,
        base=glb.texture(to_srgb(hemp), "hemp base colour", 88),
        normal=glb.texture(normal_map(relief, 0.022 / size, 0.018 / size), "hemp normal", 88),
    )
    centre = np.array([0.0, radius + 0.004, 0.0])
    ball = sphere(radius, 72, 40).moved(centre)
    ball.uvs = ball.tangents = None
    strands = []

    def strand_along(points, thickness, closed=True):
        made = tube(points + centre, thickness, 7, closed)
        length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
        made.uvs = made.uvs * np.array([1.0, length / 0.018])
        strands.append(made)

    angle = np.linspace(0, 2 * np.pi, 97)[:-1]
    reach = radius + 0.003
    for k in range(4):
        turn = np.pi * k / 4 + 0.2
        ring = np.stack([np.sin(angle) * np.cos(turn), np.cos(angle), np.sin(angle) * np.sin(turn)], 1)
        strand_along(ring * reach, 0.0036)
    for latitude in (-38, 0, 38):
        ring = np.cos(np.radians(latitude)), np.sin(np.radians(latitude))
        strand_along(
            np.stack([ring[0] * np.cos(angle), 0 * angle + ring[1], ring[0] * np.sin(angle)], 1) * (reach + 0.001),
            0.0036,
        )
    loop = np.stack([0.022 * np.sin(angle), radius + 0.020 - 0.022 * np.cos(angle), 0.006 * np.sin(2 * angle)], 1)
    strand_along(loop, 0.0042)
    net = joined(strands)
    glb.node("float", glb.mesh("glass float", [glb.primitive(net, rope), glb.primitive(ball, glass)]))
    glb.write(MODELS / "glass_float.glb")


def fleshy_leaf(length, width, thickness, rows=12, columns=10):
    """Along +z from the origin, tip curled up; returns positions (rows x columns+1) with u along the leaf."""
    t = np.linspace(0, 1, rows)[:, None]
    outline = np.sin(np.pi * np.clip(t, 0, 1) ** 0.62) ** 0.75 * (1 - 0.25 * t) + 0.10 * (1 - t)
    outline[-1] = 0.004
    a = np.linspace(0, 2 * np.pi, columns + 1)[None, :]
    side, up = np.cos(a), np.sin(a)
    x = 0.5 * width * outline * side
    y = (
        thickness * outline * np.where(up > 0, 0.35, 0.75) * up
        + 0.35 * length * t**2.2
        + 0.16 * width * outline * side**2
    )
    z = length * t + 0 * a
    return np.stack([x, y, z], -1), np.stack([0 * a + t, a / (2 * np.pi) + 0 * t], -1)


def smooth_grid(positions, uvs):
    rows, columns = positions.shape[:2]
    along = np.gradient(positions, axis=0)
    around = np.empty_like(positions)
    around[:, 1:-1] = positions[:, 2:] - positions[:, :-2]
    around[:, 0] = around[:, -1] = positions[:, 1] - positions[:, -2]
    normals = normalized(np.cross(around, along))
    made = Surface(positions.reshape(-1, 3), normals.reshape(-1, 3), grid_triangles(rows, columns), uvs.reshape(-1, 2))
    p = made.positions[made.triangles]
    facing = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), made.normals[made.triangles[:, 0]])
    if np.median(facing) < 0:
        made.triangles = made.triangles[:, ::-1]
    return without_slivers(made)


def succulent():
    """A rosette in a terracotta pot."""
    glb = Glb(GENERATOR)
    size = 512
    v, u = (np.mgrid[0:size, 0:size] + 0.5) / size
    chalk = smoothstep(0.15, 0.8, fractal(u * 6, v * 5, octaves=5, seed=2, period_x=6) + 0.35 * (1 - v))
    clay = (
        np.array([0.40, 0.135, 0.058]) * (1 + 0.16 * fractal(u * 40, v * 40, octaves=3, seed=5, period_x=40))[..., None]
    )
    clay = mix(clay, np.array([0.58, 0.45, 0.36]), 0.45 * chalk[..., None])
    relief = 0.00025 * fractal(0 * u, v * 60, octaves=2, seed=8) + 0.00012 * fractal(
        u * 90, v * 40, octaves=3, seed=9, period_x=90
    )
    pot_material = glb.material(
        "terracotta",
        roughness=0.88,
        base=glb.texture(to_srgb(clay), "terracotta base colour", 88),
        normal=glb.texture(normal_map(relief, 0.4 / size, 0.18 / size), "terracotta normal", 88),
    )
    outside = bezier_profile(
        [(0.060, 0.098), (0.060, 0.106), (0.062, 0.112), (0.066, 0.112), (0.071, 0.112), (0.072, 0.110), (0.072, 0.106),
         (0.072, 0.098), (0.071, 0.090), (0.069, 0.087), (0.066, 0.085), (0.064, 0.085), (0.063, 0.082), (0.060, 0.060),
         (0.052, 0.020), (0.048, 0.004), (0.047, 0.001), (0.046, 0.000), (0.044, 0.000)], 10)  # fmt: skip
    pot, _ = resampled(outside, 56)
    soil = glb.material("soil", (0.035, 0.024, 0.017, 1.0), roughness=1.0)
    earth = lathe([(0.001, 0.100), (0.030, 0.100), (0.061, 0.099)], 48)
    earth.uvs = earth.tangents = None

    t, a = v, u
    rim = smoothstep(0.72, 1.0, t)
    green = mix(np.array([0.13, 0.33, 0.15]), np.array([0.30, 0.50, 0.30]), smoothstep(0.1, 0.8, t)[..., None])
    green = mix(green, np.array([0.62, 0.13, 0.16]), 0.85 * rim[..., None])
    green *= (1 + 0.10 * fractal(a * 16, t * 14, octaves=4, seed=12, period_x=16))[..., None]
    leaf_material = glb.material("leaf", roughness=0.48, base=glb.texture(to_srgb(green), "leaf base colour", 88))
    leaves = []
    count = 46
    for i in range(count):
        age = (i + 1) / count  # young ones stand upright in the middle
        length = 0.020 + 0.055 * age**0.8
        positions, uvs = fleshy_leaf(length, 0.016 + 0.018 * age, 0.004 + 0.003 * age)
        tilt = np.radians(78 - 72 * age**0.75)
        c, s = np.cos(tilt), np.sin(tilt)
        y, z = positions[..., 1] * c + positions[..., 2] * s, positions[..., 2] * c - positions[..., 1] * s
        z = z + 0.006
        turn = i * np.pi * (3 - np.sqrt(5)) + 0.1 * random(i, 0, 0, 3)
        x, z = positions[..., 0] * np.cos(turn) + z * np.sin(turn), z * np.cos(turn) - positions[..., 0] * np.sin(turn)
        y = y + 0.112 - 0.010 * age
        leaves.append(smooth_grid(np.stack([x, y, z], -1), uvs[..., ::-1]))
    glb.node(
        "succulent",
        glb.mesh(
            "succulent",
            [
                glb.primitive(lathe(pot, 72), pot_material),
                glb.primitive(earth, soil),
                glb.primitive(joined(leaves), leaf_material),
            ],
        ),
    )
    glb.write(MODELS / "succulent.glb")


MAKERS = {"vase": vase, "knot": torus_knot, "sphere": chrome_sphere, "float": glass_float, "succulent": succulent}

if __name__ == "__main__":
    for name in sys.argv[1:] or MAKERS:
        MAKERS[name]()
