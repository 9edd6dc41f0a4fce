"""The demo's room, in stage space: an attic with a roof window, and what stands in it."""

import math
import random as python_random

import bmesh
import numpy as np
from mathutils import Matrix, Vector

import demo_layout as layout
import wood
from noise import fractal, mix, to_srgb
from room_parts import Paint, box, oblong, picture, pillow, quad, turned

X0, X1 = layout.ROOM_X
Z0, Z1 = layout.ROOM_Z


def board_picture():
    srgb, _, _ = wood.boards(X1 - X0, Z1 - Z0, 420, 0.145, 1.9, wood.OAK, 17)
    return picture("boards", srgb)


def plank_picture(name, palette, seed):
    """1 m x 1 m, grain along x."""
    n = 512
    v, u = (np.mgrid[0:n, 0:n] + 0.5) / n
    colour, _, _ = wood.solid(v * 0.5 - 0.25, u, 0.09 + 0 * u, palette, seed, heart=(0, 0), rings_per_metre=110)
    return picture(name, to_srgb(colour))


def rug_picture():
    n_x, n_y = 960, 480
    v, u = (np.mgrid[0:n_y, 0:n_x] + 0.5) / np.array([n_y, n_x])[:, None, None]
    ivory, rust, blue, ochre = (
        np.array(c) for c in ((0.62, 0.55, 0.43), (0.34, 0.075, 0.045), (0.035, 0.07, 0.16), (0.50, 0.27, 0.06))
    )
    x, y = u * 2.4, v * 1.2
    border = np.minimum(np.minimum(x, 2.4 - x), np.minimum(y, 1.2 - y))
    colour = np.broadcast_to(rust, (n_y, n_x, 3)).copy()
    lattice = np.abs(np.mod((x - 1.2) / 0.3 + 0.5, 1) - 0.5) + np.abs(np.mod((y - 0.6) / 0.3 + 0.5, 1) - 0.5)
    for level, tone in ((0.42, ivory), (0.36, blue), (0.22, ochre), (0.15, rust), (0.07, ivory)):
        colour[lattice < level] = tone
    colour[border < 0.15] = blue
    wedge = np.abs(np.mod(np.where((y < 0.15) | (y > 1.05), x, y) / 0.08, 1) - 0.5)
    colour[(border < 0.125) & (border > 0.035) & (wedge < 0.4 * (border - 0.035) / 0.09 + 0.06)] = ivory
    colour[(border > 0.135) & (border < 0.15)] = ochre
    colour[border < 0.022] = ochre
    pile = 1 + 0.22 * fractal(u * 320, v * 160, octaves=2, seed=5) + 0.12 * fractal(u * 4, v * 24, octaves=3, seed=8)
    return picture("rug", to_srgb(colour * pile[..., None]))


def art_picture(kind):
    n = 384
    v, u = (np.mgrid[0:n, 0:n] + 0.5) / n
    if kind == 0:  # hills under a sun
        colour = mix(np.array([0.78, 0.55, 0.34]), np.array([0.55, 0.66, 0.68]), (1 - v)[..., None])
        sun = np.hypot(u - 0.64, v - 0.34)
        colour[sun < 0.13] = (0.80, 0.22, 0.07)
        for k, tone in enumerate(((0.30, 0.40, 0.40), (0.14, 0.25, 0.26), (0.05, 0.11, 0.13), (0.42, 0.20, 0.07))):
            ridge = 0.50 + 0.12 * k + 0.07 * fractal(u * (2.2 + k), 0.37 + 1.7 * k, octaves=3, seed=40 + k)
            colour[v > ridge] = tone
    else:  # leaves of paper
        colour = np.broadcast_to(np.array([0.72, 0.65, 0.53]), (n, n, 3)).copy()
        for x, y, r, tone in (
            (0.38, 0.42, 0.25, (0.10, 0.20, 0.24)),
            (0.62, 0.60, 0.22, (0.55, 0.16, 0.07)),
            (0.56, 0.30, 0.11, (0.70, 0.42, 0.07)),
            (0.30, 0.70, 0.13, (0.20, 0.30, 0.15)),
        ):
            colour[(np.hypot(u - x, (v - y) * 0.8) < r) & (u + 0.4 * v > x + 0.4 * y - 0.6 * r)] = tone
    colour = colour * (1 + 0.05 * fractal(u * 50, v * 50, octaves=3, seed=9))[..., None]
    edge = np.minimum(np.minimum(u, 1 - u), np.minimum(v, 1 - v))
    colour[edge < 0.10] = (0.80, 0.78, 0.73)
    return picture(f"art {kind}", to_srgb(colour))


def shell(floor, walls):
    white = Paint("plaster", (0.76, 0.73, 0.68))
    sage = Paint("sage wall", (0.30, 0.36, 0.30))
    trim = Paint("trim", (0.72, 0.70, 0.65), 0.6, 0.3)
    beam = Paint("beam", (plank_picture("beam", wood.OAK * 0.62, 3), (1.0, 1.0)))
    boards = Paint("boards", (board_picture(), (X1 - X0, Z1 - Z0)), 0.5, 0.30)
    along, normal, length = layout.slope_frame()
    along, normal = Vector(along), Vector(normal)
    knee, top, ridge = layout.KNEE_WALL_HEIGHT, layout.CEILING_HEIGHT, layout.SLOPE_END_X

    plane = quad((X0, 0, Z1), (X1, 0, Z1), (X1, 0, Z0), (X0, 0, Z0))
    thing = floor.add(plane, boards)
    for loop, uv in zip(thing.data.uv_layers["metres"].data, ((0, 0), (1, 0), (1, 1), (0, 1))):
        loop.uv = (uv[0] * (X1 - X0), uv[1] * (Z1 - Z0))

    for z, paint, flip in ((Z0, sage, False), (Z1, white, True)):
        corners = [(X0, 0, z), (X1, 0, z), (X1, top, z), (ridge, top, z), (X0, knee, z)]
        walls.add(quad(*(reversed(corners) if flip else corners)), paint)
    walls.add(quad((X0, 0, Z1), (X0, 0, Z0), (X0, knee, Z0), (X0, knee, Z1)), white)
    walls.add(quad((X1, 0, Z0), (X1, 0, Z1), (X1, top, Z1), (X1, top, Z0)), white)
    walls.add(quad((ridge, top, Z0), (X1, top, Z0), (X1, top, Z1), (ridge, top, Z1)), white)
    walls.add(quad((X0, knee, Z1), (X0, knee, Z0), (ridge, top, Z0), (ridge, top, Z1)), white)
    for low, high in (
        ((X0, 0, Z0), (X1, 0.09, Z0 + 0.016)),
        ((X0, 0, Z0), (X0 + 0.016, 0.09, Z1)),
        ((X1 - 0.016, 0, Z0), (X1, 0.09, Z1)),
        ((X0, 0, Z1 - 0.016), (X1, 0.09, Z1)),
    ):
        walls.add(box(low, high, 0.004), trim)
    for z in (-3.42, -2.86, -1.24, -0.35, 0.55, 1.45):  # rafters; the window takes one's place
        start = Vector((X0, knee, z)) + normal * 0.05 - along * 0.05
        walls.add(oblong(start, start + along * (length + 0.02), (0, 0, 1), 0.09, 0.10), beam)
        walls.add(box((ridge - 0.03, top - 0.10, z - 0.045), (X1, top, z + 0.045), 0.004), beam)
    walls.add(box((ridge - 0.09, top - 0.17, Z0), (ridge + 0.07, top, Z1), 0.006), beam)

    # The roof window: a pine frame round the light.
    pine = Paint("pine", (plank_picture("pine", wood.OAK * 1.25, 8), (1.0, 1.0)), 0.5, 0.3)
    centre = Vector(layout.window_centre())
    half_s, half_z = layout.WINDOW_ALONG / 2, layout.WINDOW_ACROSS / 2
    for side in (-1, 1):
        rim = centre + along * side * (half_s + 0.03) + normal * 0.03
        walls.add(
            oblong(rim - Vector((0, 0, half_z + 0.06)), rim + Vector((0, 0, half_z + 0.06)), along, 0.06, 0.07), pine
        )
        rim = centre + Vector((0, 0, side * (half_z + 0.03))) + normal * 0.03
        walls.add(oblong(rim - along * half_s, rim + along * half_s, (0, 0, 1), 0.06, 0.07), pine)
    sky = Paint("sky", (0, 0, 0), glow=layout.WINDOW_RADIANCE)
    pane = centre + normal * 0.012
    s, w = along * half_s, Vector((0, 0, half_z))
    walls.add(quad(pane - s + w, pane - s - w, pane + s - w, pane + s + w), sky)

    # A door behind the wearer.
    door = Paint("door", (0.62, 0.60, 0.54), 0.6, 0.3)
    walls.add(box((0.55, 0, Z1 - 0.045), (1.45, 2.02, Z1), 0.01), door)
    for low, high in (((0.66, 0.25), (1.34, 0.92)), ((0.66, 1.05), (1.34, 1.88))):
        walls.add(box((low[0], low[1], Z1 - 0.06), (high[0], high[1], Z1 - 0.03), 0.012), door)


def furniture(things):
    walnut = Paint("walnut", (plank_picture("walnut", wood.WALNUT * 1.25, 12), (1.0, 1.0)), 0.7, 0.25)
    oak = Paint("oak", (plank_picture("oak", wood.OAK * 1.12, 21), (1.0, 1.0)), 0.6, 0.28)
    black = Paint("black metal", (0.03, 0.03, 0.032), 0.8, 0.25)
    fabric = Paint("fabric", (0.105, 0.15, 0.185), grain=0.35)
    mustard = Paint("mustard", (0.52, 0.28, 0.035), grain=0.3)
    coral = Paint("coral", (0.55, 0.16, 0.09), grain=0.3)
    cream = Paint("cream", (0.66, 0.60, 0.48), grain=0.2)
    rng = python_random.Random(4)

    # Side table: its top is a real surface in the demo scene.
    (ax, ay, az), (bx, by, bz) = layout.TABLE_TOP
    things.add(box((ax, ay, az), (bx, by, bz), 0.006), oak)
    for x in (ax + 0.035, bx - 0.035):
        for z in (az + 0.035, bz - 0.035):
            things.add(box((x - 0.018, 0, z - 0.018), (x + 0.018, ay, z + 0.018), 0.003), oak)
    for z in (az + 0.035, bz - 0.035):
        things.add(box((ax + 0.05, 0.13, z - 0.012), (bx - 0.05, 0.155, z + 0.012), 0.003), oak)

    # Sofa along the back wall.
    left, right, back, front = 0.28, 2.18, Z0 + 0.06, Z0 + 0.92
    things.add(box((left, 0.14, back), (right, 0.30, front - 0.03), 0.03, 3), fabric)
    for x in (left + 0.1, right - 0.1):
        for z in (back + 0.08, front - 0.12):
            things.add(box((x - 0.02, 0, z - 0.02), (x + 0.02, 0.15, z + 0.02), 0.004), walnut)
    things.add(box((left, 0.24, back), (right, 0.80, back + 0.20), 0.05, 4), fabric, smooth=True)
    for low, high in ((left - 0.02, left + 0.17), (right - 0.17, right + 0.02)):
        things.add(box((low, 0.16, back), (high, 0.60, front), 0.05, 4), fabric, smooth=True)
    middle = (left + right) / 2
    for low, high in ((left + 0.175, middle - 0.004), (middle + 0.004, right - 0.175)):
        things.add(box((low, 0.285, back + 0.18), (high, 0.46, front - 0.01), 0.035, 4, puff=0.10), fabric, smooth=True)
        things.add(
            box((low + 0.01, 0.45, back + 0.16), (high - 0.01, 0.86, back + 0.34), 0.05, 4, puff=0.16),
            fabric,
            smooth=True,
        )
    for x, turn, paint in ((left + 0.42, 14, mustard), (right - 0.40, -12, coral), (right - 0.62, 8, cream)):
        cushion = pillow(0.43, 0.40, 0.15)
        cushion.transform(
            Matrix.Translation((x, 0.66, back + 0.42))
            @ Matrix.Rotation(math.radians(turn), 4, "Y")
            @ Matrix.Rotation(math.radians(-16), 4, "X")
        )
        things.add(cushion, paint, smooth=True)

    # Rug in front of it.
    rug_low, rug_high = (-0.25, 0.0, -2.92), (2.15, 0.009, -1.72)
    rug = Paint("rug", (rug_picture(), (2.4, 1.2)))
    thing = things.add(box(rug_low, rug_high, 0.004), rug)
    for loop in thing.data.uv_layers["metres"].data:
        loop.uv = (loop.uv[0] - rug_low[0], -(loop.uv[1] - rug_high[2]))

    # Sideboard with a lamp, books and a bowl.
    sx0, sx1, sz0, sz1, height = -1.86, -0.26, Z0 + 0.02, Z0 + 0.44, 0.74
    things.add(box((sx0, 0.14, sz0), (sx1, height, sz1 - 0.015), 0.004), walnut)
    things.add(box((sx0 - 0.01, height, sz0), (sx1 + 0.01, height + 0.024, sz1), 0.005), walnut)
    width = (sx1 - sx0) / 3
    for i in range(3):
        low = sx0 + i * width + 0.012
        things.add(
            box((low, 0.16, sz1 - 0.02), (low + width - 0.024, height - 0.015, sz1 + 0.003), 0.004),
            walnut if i != 1 else oak,
        )
        things.add(
            box(
                (low + width / 2 - 0.06, height - 0.09, sz1),
                (low + width / 2 + 0.06, height - 0.078, sz1 + 0.022),
                0.004,
            ),
            black,
        )
    for x in (sx0 + 0.06, sx1 - 0.06):
        for z in (sz0 + 0.05, sz1 - 0.06):
            things.add(box((x - 0.018, 0, z - 0.018), (x + 0.018, 0.14, z + 0.018), 0.003), black)
    lamp = (sx0 + 0.38, height + 0.024, Z0 + 0.24)
    glaze = Paint("glaze", (0.10, 0.22, 0.24), 1.0, 0.1)
    things.add(
        turned(
            [
                (0.0, 0.21),
                (0.02, 0.21),
                (0.025, 0.19),
                (0.07, 0.155),
                (0.092, 0.11),
                (0.088, 0.06),
                (0.06, 0.015),
                (0.055, 0.0),
            ],
            lamp,
            40,
        ),
        glaze,
        smooth=True,
    )
    shade = Paint("shade", (0, 0, 0), glow=(2.1, 1.35, 0.72))
    things.add(turned([(0.105, 0.46), (0.165, 0.22)], lamp, 48), shade, smooth=True)

    def books(x, y, z, length, depth, tallest, along="x", facing=1):
        at = 0.0
        while True:
            thick = rng.uniform(0.016, 0.042)
            if at + thick > length:
                return
            tall, deep = tallest * rng.uniform(0.66, 1.0), depth * rng.uniform(0.75, 1.0)
            tone = rng.choice(
                (
                    (0.40, 0.06, 0.04),
                    (0.05, 0.10, 0.20),
                    (0.07, 0.16, 0.10),
                    (0.55, 0.45, 0.28),
                    (0.45, 0.22, 0.05),
                    (0.62, 0.58, 0.50),
                    (0.03, 0.035, 0.05),
                    (0.25, 0.09, 0.14),
                )
            )
            paint = book_paints.setdefault(tone, Paint("book", tone, 0.4, 0.4))
            if along == "x":
                things.add(
                    box((x + at, y, z), (x + at + thick - 0.001, y + tall, z + deep * facing), 0.002, 1)
                    if facing > 0
                    else box((x + at, y, z - deep), (x + at + thick - 0.001, y + tall, z), 0.002, 1),
                    paint,
                )
            else:
                things.add(box((x - deep, y, z + at), (x, y + tall, z + at + thick - 0.001), 0.002, 1), paint)
            at += thick

    book_paints = {}
    books(sx0 + 0.72, height + 0.024, Z0 + 0.10, 0.42, 0.20, 0.27)
    things.add(
        turned(
            [(0.135, 0.085), (0.11, 0.045), (0.05, 0.012), (0.05, 0.0)], (sx1 - 0.22, height + 0.024, Z0 + 0.24), 48
        ),
        Paint("bowl", (0.60, 0.34, 0.10), 0.9, 0.12),
        smooth=True,
    )
    things.add(
        turned(
            [(0.05, 0.012), (0.105, 0.046), (0.130, 0.085), (0.135, 0.085)][::1],
            (sx1 - 0.22, height + 0.024, Z0 + 0.24),
            48,
        ),
        cream,
        smooth=True,
    )

    # Bookcase on the right wall.
    bx0, bx1, bz0, bz1 = X1 - 0.32, X1 - 0.01, -2.02, -0.92
    for z in (bz0, bz1 - 0.024):
        things.add(box((bx0, 0, z), (bx1, 2.02, z + 0.024), 0.003), oak)
    things.add(box((bx1 - 0.012, 0.06, bz0), (bx1, 2.0, bz1), 0.001), oak)
    for i, y in enumerate((0.06, 0.44, 0.82, 1.20, 1.58, 1.996)):
        things.add(box((bx0 + 0.003, y, bz0 + 0.02), (bx1, y + 0.024, bz1 - 0.02), 0.003), oak)
        if i < 5:
            gap = rng.uniform(0.02, 0.3)
            books(bx1 - 0.03, y + 0.024, bz0 + 0.03, 1.04 - gap, 0.22, 0.29, along="z")

    # Pictures over the sofa and the sideboard.
    for kind, x, y, w, h in ((0, 0.62, 1.26, 0.66, 0.66), (1, 1.44, 1.30, 0.52, 0.52), (1, -1.05, 1.36, 0.44, 0.44)):
        for low, high in (
            ((x, y), (x + w, y + 0.022)),
            ((x, y + h - 0.022), (x + w, y + h)),
            ((x, y), (x + 0.022, y + h)),
            ((x + w - 0.022, y), (x + w, y + h)),
        ):
            things.add(box((*low, Z0), (*high, Z0 + 0.03), 0.003), oak if kind else black)
        art = Paint("art", (art_picture(kind), (w, h)), 0.5, 0.08)
        thing = things.add(
            quad((x, y, Z0 + 0.014), (x + w, y, Z0 + 0.014), (x + w, y + h, Z0 + 0.014), (x, y + h, Z0 + 0.014)), art
        )
        for loop, uv in zip(thing.data.uv_layers["metres"].data, ((0, 0), (w, 0), (w, h), (0, h))):
            loop.uv = uv

    # A snake plant between the sofa and the bookcase.
    pot = (-1.72, 0.0, -2.72)
    things.add(
        turned([(0.125, 0.27), (0.145, 0.28), (0.150, 0.27), (0.150, 0.24), (0.120, 0.0)], pot, 48),
        Paint("pot", (0.62, 0.58, 0.52), 0.5, 0.3),
        smooth=True,
    )
    things.add(turned([(0.0, 0.25), (0.128, 0.25)], pot, 48), Paint("soil", (0.03, 0.022, 0.016)))
    blade_dark, blade_light = Paint("blade", (0.05, 0.13, 0.05), 0.8, 0.3), Paint(
        "blade edge", (0.30, 0.34, 0.09), 0.8, 0.3
    )
    for i in range(15):
        turn, lean = i * 2.4, rng.uniform(0.03, 0.22)
        tall, wide = rng.uniform(0.45, 0.95), rng.uniform(0.028, 0.040)
        start = Vector((pot[0] + 0.065 * math.sin(turn * 1.7), 0.25, pot[2] + 0.065 * math.cos(turn * 1.7)))
        side, out = Vector((math.cos(turn), 0, -math.sin(turn))), Vector(
            (math.sin(turn * 1.7), 0, math.cos(turn * 1.7))
        )
        for inner, paint in ((True, blade_dark), (False, blade_light)):
            made = bmesh.new()
            rows = []
            for k in range(13):
                t = k / 12
                half = wide * min(1.0, 1.25 * (1 - t) ** 0.55) * (0.75 + 0.5 * min(t * 3, 1))
                middle_line = start + Vector((0, tall * t, 0)) + out * lean * t * t + side * 0.02 * math.sin(3 * t + i)
                cup = out * 0.25 * half
                points = (
                    [(-0.78, -0.15), (0, -0.35), (0.78, -0.15)]
                    if inner
                    else [(-1, 0), (-0.78, -0.15), None, (0.78, -0.15), (1, 0)]
                )
                rows.append(
                    [
                        None if p is None else made.verts.new(middle_line + side * half * p[0] + cup * p[1] * 4)
                        for p in points
                    ]
                )
            for low_row, high_row in zip(rows, rows[1:]):
                for a, b, c, d in zip(low_row, low_row[1:], high_row[1:], high_row):
                    if a and b:
                        made.faces.new((a, b, c, d))
            things.add(made, paint, smooth=True)
