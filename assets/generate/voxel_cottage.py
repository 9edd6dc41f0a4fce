#!/usr/bin/env python3
"""Makes assets/models/cottage.vox: a cottage with a tree, 48 x 40 x 44 voxels. Needs nothing but Python."""
import math
import pathlib
import random
import struct

SIZE = (48, 40, 44)
COLORS = [  # 1 and on, sRGB
    (106, 140, 66), (88, 122, 54), (226, 214, 190), (204, 190, 164), (150, 62, 44), (128, 50, 38),
    (92, 66, 44), (70, 50, 34), (150, 196, 220), (60, 108, 48), (78, 132, 58), (120, 116, 110), (214, 164, 60),
]
GRASS, GRASS_DARK, WALL, WALL_DARK, ROOF, ROOF_DARK, WOOD, BARK, GLASS, LEAF, LEAF_LIGHT, STONE, LAMP = range(1, 14)


def main():
    pick = random.Random(5)
    voxels = {}

    def box(low, high, *colors):
        for x in range(low[0], high[0]):
            for y in range(low[1], high[1]):
                for z in range(low[2], high[2]):
                    voxels[x, y, z] = pick.choice(colors)

    for x in range(SIZE[0]):
        for y in range(SIZE[1]):
            if math.hypot((x - 23.5) / 24, (y - 19.5) / 20) < 1:
                box((x, y, 0), (x + 1, y + 1, 2 if pick.random() < 0.93 else 3), GRASS, GRASS, GRASS_DARK)
    box((6, 12, 2), (28, 32, 4), STONE)
    box((7, 13, 4), (27, 31, 18), WALL, WALL, WALL, WALL_DARK)
    for x in (7, 26):  # gables
        for z in range(18, 27):
            box((x, 13 + (z - 18), z), (x + 1, 31 - (z - 18), z + 1), WALL, WALL_DARK)
    for step in range(11):  # roof
        color = ROOF if step % 2 else ROOF_DARK
        box((5, 11 + step, 17 + step), (29, 13 + step, 18 + step), color)
        box((5, 31 - step, 17 + step), (29, 33 - step, 18 + step), color)
    box((9, 24, 20), (13, 28, 32), STONE, STONE, WALL_DARK)  # chimney
    box((15, 12, 4), (20, 14, 13), WOOD)  # door
    voxels[19, 11, 8] = LAMP
    for x in (9, 22):  # windows
        box((x, 12, 8), (x + 4, 13, 13), WOOD)
        box((x + 1, 12, 9), (x + 3, 13, 12), GLASS)
    box((26, 19, 8), (28, 25, 13), WOOD)
    box((27, 20, 9), (28, 24, 12), GLASS)
    for i in range(5):  # path
        box((15 + i % 2, 3 + 2 * i, 2), (19 + i % 2, 4 + 2 * i, 3), STONE)
    box((38, 18, 2), (41, 21, 22), BARK, BARK, WOOD)  # tree
    for cx, cy, cz, r in ((39, 19, 29, 9), (35, 23, 24, 5), (43, 16, 25, 5)):
        for x in range(cx - r, cx + r + 1):
            for y in range(cy - r, cy + r + 1):
                for z in range(cz - r, cz + r + 1):
                    rim = math.dist((x, y, z), (cx, cy, cz)) / r
                    if rim < 0.8 or (rim < 1.05 and pick.random() < 0.55):
                        voxels.setdefault((x, y, z), pick.choice((LEAF, LEAF, LEAF_LIGHT)))

    def chunk(name, content, children=b""):
        return name + struct.pack("<ii", len(content), len(children)) + content + children

    inside = sorted((z, y, x, c) for (x, y, z), c in voxels.items() if all(0 <= p < s for p, s in zip((x, y, z), SIZE)))
    palette = b"".join(bytes((*c, 255)) for c in COLORS).ljust(1024, b"\0")
    body = (chunk(b"SIZE", struct.pack("<iii", *SIZE))
            + chunk(b"XYZI", struct.pack("<i", len(inside)) + b"".join(bytes((x, y, z, c)) for z, y, x, c in inside))
            + chunk(b"RGBA", palette))
    file = pathlib.Path(__file__).parent.parent / "models" / "cottage.vox"
    file.write_bytes(b"VOX " + struct.pack("<i", 150) + chunk(b"MAIN", b"", body))


main()
