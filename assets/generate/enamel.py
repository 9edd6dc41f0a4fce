"""Paints the demo vase: cloisonné, enamel cells between gold wires. Gives base colour, normal and metallic-roughness.

The picture is half the vase's circumference (518 mm at the belly) by its outer profile (605 mm), and tiles in x.
"""

import math

import cairo
import numpy as np

from noise import blurred, fractal, mix, normal_map, random, smoothstep, to_linear, to_srgb

WIDTH, HEIGHT = 518.0, 605.0  # mm
SIZE = 1024
OVERSAMPLE = 2
OUTLINE, FINE = 1.15, 0.62  # wire widths, mm

LAPIS, LAPIS_LIGHT = "#0a2f7a", "#1762b0"
TURQUOISE, TURQUOISE_LIGHT = "#0b7f8c", "#35b6b0"
CORAL, CORAL_LIGHT = "#b3261b", "#e2603a"
LEAF, LEAF_LIGHT = "#14692f", "#63b04a"
IVORY, BLUSH, ROSE = "#fbf3e2", "#f4b9b6", "#cf4a68"
YELLOW, AMBER = "#f6cf4e", "#dd8a1e"
NAVY = "#071a4a"


def rgb(text):
    return tuple(int(text[i : i + 2], 16) / 255 for i in (1, 3, 5))


class Painter:
    """Enamel colours and, apart from them, the wires. Everything is drawn once more a period to either side."""

    def __init__(self):
        n = SIZE * OVERSAMPLE
        self.colour_surface = cairo.ImageSurface(cairo.FORMAT_RGB24, n, n)
        self.wire_surface = cairo.ImageSurface(cairo.FORMAT_A8, n, n)
        self.colour = cairo.Context(self.colour_surface)
        self.wire = cairo.Context(self.wire_surface)
        for context in (self.colour, self.wire):
            context.scale(n / WIDTH, n / HEIGHT)
            context.set_line_cap(cairo.LINE_CAP_ROUND)
            context.set_line_join(cairo.LINE_JOIN_ROUND)

    def _everywhere(self, context, draw):
        for shift in (-WIDTH, 0.0, WIDTH):
            context.save()
            context.translate(shift, 0)
            draw(context)
            context.restore()

    def cell(self, path, fill, width=OUTLINE):
        """`path(context)` traces an outline; `fill` is a colour or a cairo pattern; it hides what lay below."""

        def paint(context):
            path(context)
            if isinstance(fill, str):
                context.set_source_rgb(*rgb(fill))
            else:
                context.set_source(fill)
            context.fill()

        def bend_wire(context):
            path(context)
            context.set_operator(cairo.OPERATOR_DEST_OUT)
            context.fill_preserve()
            context.set_operator(cairo.OPERATOR_OVER)
            context.set_line_width(width)
            context.stroke()

        self._everywhere(self.colour, paint)
        self._everywhere(self.wire, bend_wire)

    def line(self, path, width=FINE):
        def bend_wire(context):
            path(context)
            context.set_line_width(width)
            context.stroke()

        self._everywhere(self.wire, bend_wire)

    def gold(self, path):
        def bend_wire(context):
            path(context)
            context.fill()

        self._everywhere(self.wire, bend_wire)

    def band(self, top, bottom, fill, width=OUTLINE):
        self.cell(lambda c: c.rectangle(-3 * WIDTH, top, 7 * WIDTH, bottom - top), fill, width)

    def colours(self):
        n = SIZE * OVERSAMPLE
        data = np.frombuffer(self.colour_surface.get_data(), np.uint8).reshape(n, n, 4)[..., 2::-1] / 255.0
        return halved(to_linear(data))

    def wires(self):
        n = SIZE * OVERSAMPLE
        stride = self.wire_surface.get_stride()
        data = np.frombuffer(self.wire_surface.get_data(), np.uint8).reshape(n, stride)[:, :n] / 255.0
        return halved(data)


def halved(a):
    k = OVERSAMPLE
    return a.reshape(SIZE, k, SIZE, k, *a.shape[2:]).mean((1, 3))


def radial(x, y, r0, inner, r1, outer):
    pattern = cairo.RadialGradient(x, y, r0, x, y, r1)
    pattern.add_color_stop_rgb(0, *rgb(inner))
    pattern.add_color_stop_rgb(1, *rgb(outer))
    return pattern


def linear(x0, y0, first, x1, y1, last):
    pattern = cairo.LinearGradient(x0, y0, x1, y1)
    pattern.add_color_stop_rgb(0, *rgb(first))
    pattern.add_color_stop_rgb(1, *rgb(last))
    return pattern


def turned(x, y, angle, draw):
    """A path drawn in a frame at (x, y) whose +x points along `angle`."""

    def path(context):
        context.save()
        context.translate(x, y)
        context.rotate(angle)
        draw(context)
        context.restore()

    return path


def petal(r0, r1, half_width, notch=0.12):
    """From radius r0 to r1 along +x, widest near the tip, which is notched like a peony's."""
    span = r1 - r0

    def draw(c):
        c.move_to(r0, 0)
        c.curve_to(
            r0 + 0.25 * span,
            -half_width * 0.95,
            r0 + 0.62 * span,
            -half_width * 1.15,
            r0 + 0.90 * span,
            -half_width * 0.62,
        )
        c.curve_to(r1 + 0.02 * span, -half_width * 0.35, r1, -half_width * 0.12, r1 - notch * span, 0)
        c.curve_to(r1, half_width * 0.12, r1 + 0.02 * span, half_width * 0.35, r0 + 0.90 * span, half_width * 0.62)
        c.curve_to(r0 + 0.62 * span, half_width * 1.15, r0 + 0.25 * span, half_width * 0.95, r0, 0)
        c.close_path()

    return draw


def flower(p, x, y, rings, heart, veins=2):
    """`rings`: (petals, inner radius, outer radius, half width, colour at the heart, colour at the tip, turn), outermost first."""
    for count, r0, r1, half, inner, outer, turn in rings:
        for i in range(count):
            angle = 2 * math.pi * (i + turn) / count
            p.cell(turned(x, y, angle, petal(r0, r1, half)), radial(x, y, r0 + 0.1 * (r1 - r0), inner, r1, outer))
            for k in range(-veins, veins + 1):
                slope = 0.62 * k / max(veins, 1) * half

                def vein(c, slope=slope):
                    c.move_to(r0 + 0.30 * (r1 - r0), slope * 0.35)
                    c.curve_to(
                        r0 + 0.5 * (r1 - r0), slope * 0.8, r0 + 0.6 * (r1 - r0), slope, r0 + 0.74 * (r1 - r0), slope
                    )

                p.line(turned(x, y, angle, vein))
    p.cell(lambda c: c.arc(x, y, heart, 0, 2 * math.pi), radial(x, y, 0, YELLOW, heart, AMBER))
    for ring, count in ((0.32, 5), (0.68, 11)):
        for i in range(count):
            angle = 2 * math.pi * i / count
            dot = (x + ring * heart * math.cos(angle), y + ring * heart * math.sin(angle))
            p.gold(lambda c, dot=dot: c.arc(*dot, heart * 0.085, 0, 2 * math.pi))


def leaf(p, x, y, angle, length, width, bend=0.25, dark=LEAF, light=LEAF_LIGHT):
    tip = (length, bend * length)

    def outline(c):
        c.move_to(0, 0)
        c.curve_to(length * 0.25, -width, length * 0.75, -width + bend * length * 0.4, *tip)
        c.curve_to(length * 0.70, width * 0.9 + bend * length * 0.55, length * 0.25, width, 0, 0)
        c.close_path()

    ends = [(x, y), (x + length * math.cos(angle), y + length * math.sin(angle))]
    p.cell(turned(x, y, angle, outline), linear(*ends[0], dark, *ends[1], light))

    def rib(c):
        c.move_to(0, 0)
        c.curve_to(length * 0.3, 0, length * 0.7, bend * length * 0.35, tip[0] * 0.96, tip[1] * 0.95)
        for t in (0.25, 0.42, 0.59, 0.75):
            bx, by = length * t, bend * length * t * t * 0.8
            reach = width * (0.62 if t < 0.6 else 0.40)
            c.move_to(bx, by)
            c.line_to(bx + length * 0.10, by - reach)
            c.move_to(bx, by)
            c.line_to(bx + length * 0.10, by + reach * 1.1)

    p.line(turned(x, y, angle, rib))


def spiral(x, y, radius, start, turns, direction=1, steps=40):
    def path(c):
        for i in range(steps + 1):
            t = i / steps
            a = start + direction * 2 * math.pi * turns * t
            r = radius * (1 - t) ** 0.8
            point = (x + r * math.cos(a), y + r * math.sin(a))
            c.line_to(*point) if i else c.move_to(*point)

    return path


def ground(p, top, bottom):
    """Cloud curls, close together, over the enamel between the flowers."""
    pattern = linear(0, top, TURQUOISE, 0, bottom, LAPIS_LIGHT)
    pattern.add_color_stop_rgb(0.45, *rgb("#0d5f9c"))
    p.band(top, bottom, pattern)
    pitch_x = WIDTH / 36
    rows = int((bottom - top) / 12.4)
    for row in range(rows):
        for column in range(36):
            jitter = random(column, row, 0, 5), random(column, row, 1, 5), random(column, row, 2, 5)
            x = (column + 0.5 * (row % 2) + 0.25 * (jitter[0] - 0.5)) * pitch_x
            y = top + 8.5 + (row + 0.25 * (jitter[1] - 0.5)) * 12.4
            if y > bottom - 6:
                continue
            p.line(spiral(x, y, 5.0, jitter[2] * 6.28, 1.35, 1 if (row + column) % 2 else -1), 0.7)


def key_fret(p, top, bottom, count):
    p.band(top, bottom, NAVY)
    unit, tall = WIDTH / count, bottom - top

    def path(c):
        for i in range(count):
            x, y = i * unit, top
            points = [(0.06, 0.80), (0.06, 0.20), (0.80, 0.20), (0.80, 0.64), (0.38, 0.64), (0.38, 0.44), (0.58, 0.44)]
            for k, (a, b) in enumerate(points):
                (c.line_to if k else c.move_to)(x + a * unit, y + b * tall)
            c.move_to(x + 0.06 * unit, y + 0.80 * tall)
            c.line_to(x + 1.06 * unit, y + 0.80 * tall)

    p.line(path, 1.0)


def ruyi(p, top, bottom, count):
    """A collar of cloud heads that hang from the shoulder."""
    p.band(top, bottom, linear(0, top, CORAL, 0, bottom, CORAL_LIGHT))
    unit, tall = WIDTH / count, bottom - top

    def head(scale):
        def draw(c):
            w, h = unit * 0.47 * scale, tall * 0.90 * scale
            c.move_to(-w, 0)
            c.curve_to(-w * 1.02, h * 0.35, -w * 0.98, h * 0.62, -w * 0.55, h * 0.62)
            c.curve_to(-w * 0.35, h * 0.62, -w * 0.12, h * 0.78, 0, h)
            c.curve_to(w * 0.12, h * 0.78, w * 0.35, h * 0.62, w * 0.55, h * 0.62)
            c.curve_to(w * 0.98, h * 0.62, w * 1.02, h * 0.35, w, 0)
            c.close_path()

        return draw

    for i in range(count):
        x = (i + 0.5) * unit
        p.cell(turned(x, top, 0, head(1.0)), linear(0, top, LAPIS, 0, bottom, LAPIS_LIGHT))
        p.cell(turned(x, top, 0, head(0.74)), linear(0, top, TURQUOISE, 0, bottom, TURQUOISE_LIGHT))
        p.cell(turned(x, top, 0, head(0.44)), linear(0, top, AMBER, 0, top + tall * 0.4, YELLOW), FINE)
        for side in (-1, 1):
            p.line(spiral(x + side * unit * 0.25, top + tall * 0.34, unit * 0.13, math.pi / 2, 1.2, side))
        mid = (i + 1.0) * unit
        p.cell(lambda c, mid=mid: c.arc(mid, bottom - tall * 0.20, 2.6, 0, 2 * math.pi), IVORY, FINE)


def plantain(p, top, bottom, count):
    """Tall leaves that stand round the neck, in two ranks."""
    p.band(top, bottom, linear(0, top, TURQUOISE_LIGHT, 0, bottom, TURQUOISE))
    unit, tall = WIDTH / count, bottom - top
    for rank, (height, dark, light) in enumerate(((0.94, CORAL, CORAL_LIGHT), (0.80, LAPIS, LAPIS_LIGHT))):
        for i in range(count):
            x = (i + 0.5 * rank) * unit
            h, w = tall * height, unit * 0.46

            def blade(scale, w=w, h=h):
                def draw(c):
                    c.move_to(-w * scale, 0)
                    c.curve_to(-w * scale, -h * 0.5 * scale, -w * 0.35 * scale, -h * 0.8 * scale, 0, -h * scale)
                    c.curve_to(w * 0.35 * scale, -h * 0.8 * scale, w * scale, -h * 0.5 * scale, w * scale, 0)
                    c.close_path()

                return draw

            p.cell(turned(x, bottom, 0, blade(1.0)), linear(0, bottom, dark, 0, bottom - h, light))
            p.cell(turned(x, bottom, 0, blade(0.62)), linear(0, bottom, YELLOW, 0, bottom - h * 0.6, IVORY), FINE)

            def veins(c, x=x, h=h, w=w):
                c.move_to(x, bottom)
                c.line_to(x, bottom - h * 0.90)
                for k in range(1, 9):
                    y = bottom - h * (0.06 + 0.075 * k)
                    reach = w * (0.80 - 0.075 * k)
                    c.move_to(x - reach, y - 3)
                    c.line_to(x, y + 2)
                    c.line_to(x + reach, y - 3)

            p.line(veins)


def lappets(p, top, bottom, count):
    """Lotus petals that rise from the foot."""
    p.band(top, bottom, linear(0, top, LAPIS_LIGHT, 0, bottom, NAVY))
    unit, tall = WIDTH / count, bottom - top
    for rank, offset in ((0, 0.0), (1, 0.5)):
        for i in range(count):
            x = (i + offset) * unit
            h = tall * (0.92 if rank == 0 else 0.74)
            w = unit * 0.48

            def lotus(scale, w=w, h=h):
                def draw(c):
                    c.move_to(-w * 0.72 * scale, 0)
                    c.curve_to(-w * 1.2 * scale, -h * 0.45 * scale, -w * 0.9 * scale, -h * 0.80 * scale, 0, -h * scale)
                    c.curve_to(
                        w * 0.9 * scale, -h * 0.80 * scale, w * 1.2 * scale, -h * 0.45 * scale, w * 0.72 * scale, 0
                    )
                    c.close_path()

                return draw

            colours = (TURQUOISE, TURQUOISE_LIGHT) if rank == 0 else (ROSE, BLUSH)
            p.cell(turned(x, bottom, 0, lotus(1.0)), linear(0, bottom, colours[0], 0, bottom - h, colours[1]))
            p.cell(turned(x, bottom, 0, lotus(0.72)), linear(0, bottom, BLUSH if rank else LAPIS, 0, bottom - h, IVORY))
            p.cell(turned(x, bottom, 0, lotus(0.40)), linear(0, bottom, AMBER, 0, bottom - h * 0.4, YELLOW), FINE)

            def veins(c, x=x, h=h, w=w):
                for k in (-2, -1, 0, 1, 2):
                    c.move_to(x + k * w * 0.16, bottom - h * 0.42)
                    c.line_to(x + k * w * 0.24, bottom - h * (0.62 - 0.03 * k * k))

            p.line(veins)


def waves(p, top, bottom, count):
    p.band(top, bottom, LAPIS)
    unit = WIDTH / count
    for row in range(3, -1, -1):
        y = bottom - row * (bottom - top) / 4.2
        for i in range(-1, count + 1):
            x = (i + 0.5 * (row % 2)) * unit
            for k, colour in ((1.0, IVORY), (0.80, LAPIS_LIGHT), (0.56, IVORY), (0.36, LAPIS)):
                p.cell(
                    lambda c, x=x, k=k: (
                        c.move_to(x - unit * 0.5 * k, y),
                        c.arc(x, y, unit * 0.5 * k, math.pi, 2 * math.pi),
                        c.close_path(),
                    ),
                    colour,
                    FINE,
                )


def beads(p, top, bottom, count):
    p.band(top, bottom, CORAL)
    unit, y = WIDTH / count, (top + bottom) / 2
    for i in range(count):
        p.cell(lambda c, i=i: c.arc((i + 0.5) * unit, y, (bottom - top) * 0.30, 0, 2 * math.pi), IVORY, FINE)


def scrolls(p):
    """Stems, leaves and flowers of the body; mirrored about the big flower that faces the wearer."""
    mid, level = WIDTH / 2, 306.0
    volutes = [(128.0, 226.0, 34.0, 1), (118.0, 398.0, 38.0, -1)]
    for side in (-1, 1):

        def at(x):
            return mid + side * (x - mid)

        def angle(a):
            return a if side == 1 else math.pi - a

        for x, y, radius, up in volutes:

            def stem(c, x=x, y=y, radius=radius, up=up):
                c.move_to(at(mid - 40), level + up * 20)
                c.curve_to(
                    at(mid - 90),
                    level - up * 10,
                    at(x + radius + 34),
                    y + up * radius * 1.5,
                    at(x + 4),
                    y + up * radius,
                )
                c.curve_to(
                    at(x - radius * 1.30),
                    y + up * radius * 0.9,
                    at(x - radius * 1.25),
                    y - up * radius * 1.0,
                    at(x),
                    y - up * radius,
                )
                c.curve_to(
                    at(x + radius * 1.05),
                    y - up * radius * 0.95,
                    at(x + radius * 0.9),
                    y + up * radius * 0.45,
                    at(x + 6),
                    y + up * radius * 0.30,
                )

            p.line(stem, 3.6)
            p.line(stem, 3.6)

            def twig(c, x=x, y=y, radius=radius, up=up):
                c.move_to(at(x - radius * 0.9), y + up * radius * 0.4)
                c.curve_to(at(x - radius * 1.5), y + up * radius * 1.2, at(60), level + up * 8, at(20), level + up * -4)

            p.line(twig, 2.6)
            for lx, ly, a, length, width in (
                (x + radius * 1.45, y + up * radius * 1.05, -0.5 * up, 40, 11),
                (x + radius * 0.55, y - up * radius * 0.86, -1.05 * up, 40, 11),
                (x - radius * 0.75, y - up * radius * 0.85, (-2.25) * up, 38, 10),
                (x - radius * 1.02, y + up * radius * 0.1, (2.75) * up, 34, 9),
                (x - radius * 0.55, y + up * radius * 0.92, (2.1) * up, 36, 10),
                (x + radius * 0.6, y + up * radius * 1.12, 1.5 * up, 32, 9),
            ):
                leaf(p, at(lx), ly, angle(a), length, width, 0.22 * up * side)
            colours = (YELLOW, CORAL_LIGHT) if up == 1 else (IVORY, ROSE)
            flower(
                p,
                at(x),
                y,
                [(8, 4, 25, 8.2, colours[1], colours[0], 0.0), (6, 3, 17, 7.0, colours[0], colours[1], 0.5)],
                5.5,
                veins=1,
            )
    for x, y, a in ((mid, 205, -math.pi / 2), (mid, 412, math.pi / 2)):
        for spread in (-0.75, 0.75):
            leaf(p, x, y, a + spread, 44, 11, 0.2 * (1 if spread < 0 else -1) * (1 if a < 0 else 1))
        leaf(p, x, y, a, 40, 10, 0.0)
    for i in range(12):
        a = 2 * math.pi * (i + 0.5) / 12
        leaf(p, mid + 74 * math.cos(a), level + 74 * math.sin(a), a, 40, 13, 0.0)
    flower(
        p, mid, level,
        [
            (12, 30, 94, 22.0, ROSE, IVORY, 0.0),
            (11, 20, 74, 19.0, ROSE, BLUSH, 0.3),
            (9, 12, 55, 17.0, CORAL, "#fbd9cf", 0.1),
            (7, 8, 38, 14.5, ROSE, IVORY, 0.6),
        ],
        17.0, veins=3,
    )  # fmt: skip
    for i in range(8):
        a = 2 * math.pi * (i + 0.5) / 8
        leaf(p, 44 * math.cos(a), level + 44 * math.sin(a), a, 34, 10, 0.0)
    flower(
        p, 0.0, level,
        [
            (16, 18, 58, 11.5, AMBER, YELLOW, 0.0),
            (13, 12, 44, 10.5, CORAL, CORAL_LIGHT, 0.4),
            (9, 8, 30, 9.5, CORAL, YELLOW, 0.2),
        ],
        11.0, veins=1,
    )  # fmt: skip


def paint():
    """(base colour sRGB, normal, metallic-roughness), each SIZE x SIZE x 3."""
    p = Painter()
    ground(p, 178, 472)
    scrolls(p)
    p.band(9, 15, CORAL)
    key_fret(p, 15, 33, 20)
    plantain(p, 34, 116, 10)
    beads(p, 116, 125, 44)
    ruyi(p, 125, 171, 12)
    beads(p, 171, 179, 56)
    beads(p, 471, 479, 52)
    waves(p, 562, 592, 18)
    lappets(p, 479, 556, 14)
    beads(p, 556, 563, 48)
    p.gold(lambda c: c.rectangle(-3 * WIDTH, -2, 7 * WIDTH, 12))
    p.gold(lambda c: c.rectangle(-3 * WIDTH, 592, 7 * WIDTH, 14))
    for y in (33.5, 116, 125, 171, 179, 471, 479, 556, 563):
        p.line(lambda c, y=y: (c.move_to(-WIDTH, y), c.line_to(2 * WIDTH, y)), 1.8)

    enamel, wire = p.colours(), np.clip(p.wires(), 0, 1)
    v, u = np.mgrid[0:SIZE, 0:SIZE] / SIZE
    mottle = fractal(u * 24, v * 28, octaves=5, seed=11, period_x=24)
    pits = smoothstep(0.62, 0.9, fractal(u * 128, v * 150, octaves=2, seed=31, period_x=128))
    enamel = enamel * (1 + 0.16 * mottle)[..., None] * (1 - 0.35 * pits)[..., None]
    near_wire = np.clip(blurred(wire, 2.2), 0, 1)
    enamel *= (1 - 0.30 * near_wire)[..., None]  # enamel is thin and dark where it meets the wire
    gold = (
        np.array([1.0, 0.69, 0.27]) * (0.93 + 0.05 * fractal(u * 90, v * 90, octaves=2, seed=7, period_x=90))[..., None]
    )
    base = mix(enamel, gold, wire[..., None])

    height = (
        0.00030 * blurred(wire, 0.8)
        - 0.00003 * pits
        + 0.00006 * fractal(u * 40, v * 46, octaves=2, seed=3, period_x=40)
    )
    normal = normal_map(height, WIDTH / 1000 / SIZE, HEIGHT / 1000 / SIZE)
    roughness = mix(0.15 + 0.05 * mottle + 0.25 * pits, 0.26 + 0.04 * mottle, wire)
    surface = np.stack([np.ones_like(wire), np.clip(roughness, 0.06, 1), wire], -1)
    return to_srgb(base), normal, surface
