"""Wood as a solid: colour, gloss and relief at any point in space, so that turned things show rings on top and grain
along the side; and oak boards for a floor."""

import numpy as np

from noise import fractal, mix, noise, normal_map, random, smoothstep, to_srgb

WALNUT = np.array([[0.065, 0.028, 0.012], [0.20, 0.095, 0.042], [0.32, 0.17, 0.080]])
OAK = np.array([[0.20, 0.105, 0.045], [0.40, 0.235, 0.115], [0.53, 0.345, 0.19]])


def solid(x, y, z, palette, seed=0, heart=(0.03, 0.16), rings_per_metre=170.0):
    """Colour (linear), roughness and height (metres) at points in metres; the tree stood along y, its heart at `heart`."""
    wobble = 0.012 * fractal(x * 5, y * 0.9, z * 5, octaves=3, seed=seed)
    lean_x = x - heart[0] - 0.05 * y + wobble
    lean_z = z - heart[1] + 0.03 * y + 0.012 * noise(x * 4, y * 0.8, z * 4, seed + 9)
    ring = np.hypot(lean_x, lean_z) * rings_per_metre
    year = np.floor(ring)
    phase = ring - year
    late = smoothstep(0.35, 0.92, phase) * (1 - smoothstep(0.94, 1.0, phase))
    strength = 0.55 + 0.45 * random(year.astype(int), 0, 0, seed)
    fibre = fractal(x * 420, y * 14, z * 420, octaves=3, seed=seed + 20)
    pores = smoothstep(0.35, 0.75, noise(x * 900, y * 22, z * 900, seed + 40)) * (1 - 0.6 * late)
    broad = 0.5 + 0.5 * fractal(x * 9, y * 1.5, z * 9, octaves=2, seed=seed + 50)
    tone = np.clip(0.62 - 0.50 * late * strength + 0.16 * fibre + 0.30 * (broad - 0.5), 0, 1)
    colour = np.stack([np.interp(tone, [0, 0.5, 1], palette[:, k]) for k in range(3)], -1)
    colour *= (1 - 0.55 * pores)[..., None]
    roughness = 0.34 + 0.10 * late - 0.04 * fibre + 0.22 * pores
    height = -0.00012 * pores - 0.00002 * late + 0.00002 * fibre
    return colour, roughness, height


def turned(profile, length, size, palette, seed, heart):
    """Textures for shapes.lathe of this profile (equally spaced points): base colour sRGB, normal, metallic-roughness."""
    v, u = (np.mgrid[0:size, 0:size] + 0.5) / size
    at = v[:, 0] * (len(profile) - 1)
    radius = np.interp(at, np.arange(len(profile)), profile[:, 0])[:, None]
    height = np.interp(at, np.arange(len(profile)), profile[:, 1])[:, None]
    theta = (u - 0.5) * 2 * np.pi
    colour, roughness, relief = solid(
        radius * np.sin(theta), height + 0 * u, radius * np.cos(theta), palette, seed, heart, 130.0
    )
    # Fine marks of the turning, and dark wax where beads meet coves.
    relief = relief + 0.000012 * noise(0 * u, v * length * 2600, 0, seed + 70)
    bend = np.abs(np.gradient(np.gradient(radius[:, 0])))
    grime = np.clip(np.convolve(bend, np.ones(9) / 9, "same") * size * 0.02, 0, 0.45)
    colour = colour * (1 - grime)[:, None, None]
    normal = normal_map(relief, 2 * np.pi * float(np.mean(profile[:, 0])) / size, length / size)
    surface = np.stack([np.ones_like(roughness), np.clip(roughness, 0.05, 1), np.zeros_like(roughness)], -1)
    return to_srgb(colour), normal, surface


def boards(width, depth, pixels_per_metre, board_width, board_length, palette, seed):
    """A boarded floor, boards along the picture's y: (base colour sRGB, height in metres, gap mask)."""
    rows, columns = int(depth * pixels_per_metre), int(width * pixels_per_metre)
    y, x = (np.mgrid[0:rows, 0:columns] + 0.5) / pixels_per_metre
    column = np.floor(x / board_width).astype(int)
    shifted = y + random(column, 0, 0, seed) * board_length
    row = np.floor(shifted / board_length).astype(int)
    board = [random(column, row, k, seed + 1) for k in range(6)]
    across = x - column * board_width
    along = shifted - row * board_length
    colour, roughness, height = solid(
        across - board_width / 2 + 0.5 * (board[0] - 0.5),
        along + 7.0 * board[1],
        (0.02 + 0.16 * board[2]) + 0 * x,
        palette,
        seed + 2,
        heart=(0.0, 0.0),
        rings_per_metre=130.0,
    )
    colour = colour * (0.78 + 0.44 * board[3])[..., None]
    colour *= np.stack([1 + 0.06 * (board[4] - 0.5), np.ones_like(x), 1 - 0.14 * (board[4] - 0.5)], -1)
    edge = np.minimum(np.minimum(across, board_width - across), np.minimum(along, board_length - along))
    gap = 1 - smoothstep(0.0007, 0.0030, edge)
    colour = mix(colour, colour * 0.16, gap[..., None])
    return to_srgb(colour), height - 0.0012 * gap, gap
