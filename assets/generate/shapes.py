"""Smooth surfaces as triangles: things turned on a lathe, tubes, spheres, boxes. Metres, y up."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Surface:
    positions: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    uvs: np.ndarray | None = None
    tangents: np.ndarray | None = None  # xyz along growing u; w: sign of the bitangent (up in the picture)

    def moved(self, offset):
        return Surface(self.positions + np.asarray(offset), self.normals, self.triangles, self.uvs, self.tangents)


def joined(surfaces):
    start = np.cumsum([0] + [len(s.positions) for s in surfaces[:-1]])

    def stack(name):
        parts = [getattr(s, name) for s in surfaces]
        return None if any(p is None for p in parts) else np.concatenate(parts)

    triangles = np.concatenate([s.triangles + n for s, n in zip(surfaces, start)])
    return Surface(stack("positions"), stack("normals"), triangles, stack("uvs"), stack("tangents"))


def normalized(v):
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-20)


def grid_triangles(rows, columns):
    """Two triangles a cell of a rows x columns grid of vertices; counter-clockwise when row 0 is on top."""
    r, c = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
    a = (r * columns + c).ravel()
    b, d, e = a + columns, a + 1, a + columns + 1
    return np.concatenate([np.stack([a, b, d], 1), np.stack([d, b, e], 1)])


def without_slivers(surface):
    p = surface.positions[surface.triangles]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    surface.triangles = surface.triangles[area > 1e-12]
    return surface


def bezier_profile(points, pieces):
    """Cubic Bezier pieces in one list of (radius, height): p0, c, c, p1, c, c, p2 …; `pieces` samples each."""
    points = np.asarray(points, float)
    t = np.linspace(0, 1, pieces + 1)[:-1, None]
    out = []
    for i in range(0, len(points) - 3, 3):
        a, b, c, d = points[i : i + 4]
        out.append((1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t**2 * c + t**3 * d)
    return np.concatenate([*out, points[-1:]])


def resampled(profile, count):
    """`count` points at equal steps along the profile."""
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))])
    at = np.linspace(0, length[-1], count)
    return np.stack([np.interp(at, length, profile[:, k]) for k in (0, 1)], 1), length[-1]


def lathe(profile, segments, u_repeat=1.0):
    """Turns a profile of (radius, height), top to bottom on the outside, round the y axis. u = 1/2 faces +z and
    grows to the right as seen from outside; v runs 0..1 along the profile."""
    profile = np.asarray(profile, float)
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))])
    v = length / length[-1]
    slope = np.gradient(profile, np.maximum(v, 1e-9) if len(v) < 3 else v, axis=0)
    slope = normalized(slope)
    theta = np.linspace(-np.pi, np.pi, segments + 1)
    s, c = np.sin(theta), np.cos(theta)
    radius, height = profile[:, :1], profile[:, 1:]
    positions = np.stack([radius * s, np.broadcast_to(height, (len(profile), segments + 1)), radius * c], -1)
    nr, ny = -slope[:, 1:], slope[:, :1]  # the profile runs down outside: outward is the tangent turned left
    normals = np.stack([nr * s, np.broadcast_to(ny, positions.shape[:2]), nr * c], -1)
    tangents = np.stack([c, np.zeros_like(c), -s, np.ones_like(c)], -1)
    tangents = np.broadcast_to(tangents, (len(profile), segments + 1, 4))
    u = np.broadcast_to((theta / (2 * np.pi)) * u_repeat + 0.5, positions.shape[:2])
    uvs = np.stack([u, np.broadcast_to(v[:, None], u.shape)], -1)
    return without_slivers(
        Surface(
            positions.reshape(-1, 3),
            normalized(normals).reshape(-1, 3),
            grid_triangles(len(profile), segments + 1),
            uvs.reshape(-1, 2),
            np.array(tangents).reshape(-1, 4),
        )
    )


def sphere(radius, segments, rings):
    """Centred at the origin."""
    angle = np.linspace(0, np.pi, rings + 1)
    surface = lathe(np.stack([radius * np.sin(angle), radius * np.cos(angle)], 1), segments)
    surface.normals = normalized(surface.positions)
    return surface


def tube(path, radius, sides, closed=True):
    """A round tube along a smooth path (n x 3), its frame carried along without twisting."""
    path = np.asarray(path, float)
    n = len(path)
    along = normalized(np.roll(path, -1, 0) - np.roll(path, 1, 0)) if closed else normalized(np.gradient(path, axis=0))
    normal = np.empty_like(path)
    seed = np.array([0.0, 1.0, 0.0]) if abs(along[0, 1]) < 0.9 else np.array([1.0, 0.0, 0.0])
    normal[0] = normalized(np.cross(along[0], seed))
    for i in range(1, n):
        normal[i] = normalized(normal[i - 1] - along[i] * np.dot(along[i], normal[i - 1]))
    turn = 0.0
    if closed:  # spread what is missing to meet the start over the whole length
        last = normalized(normal[-1] - along[0] * np.dot(along[0], normal[-1]))
        turn = np.arctan2(np.dot(np.cross(last, normal[0]), along[0]), np.dot(last, normal[0]))
    rows = n + 1 if closed else n
    theta = np.linspace(0, 2 * np.pi, sides + 1)
    positions, normals, uvs = [], [], []
    radii = np.broadcast_to(radius, n)
    for i in range(rows):
        k = i % n
        a = theta + turn * i / n
        base = normal[k] if i < n else normal[0]
        if i == n:
            a = theta
        other = np.cross(along[k], base)
        direction = np.cos(a)[:, None] * base + np.sin(a)[:, None] * other
        positions.append(path[k] + radii[k] * direction)
        normals.append(direction)
        uvs.append(np.stack([theta / (2 * np.pi), np.full_like(theta, i / (rows - 1))], 1))
    triangles = grid_triangles(rows, sides + 1)[:, ::-1]
    return Surface(np.concatenate(positions), np.concatenate(normals), triangles, np.concatenate(uvs))


def box(size):
    """Centred at the origin; flat faces, each with UVs 0..1."""
    corners, normals, uvs, triangles = [], [], [], []
    half = np.asarray(size, float) / 2
    for axis in range(3):
        for sign in (-1, 1):
            n = np.zeros(3)
            n[axis] = sign
            right = np.zeros(3)
            right[(axis + 1) % 3] = sign
            up = np.cross(n, right)
            start = len(corners)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corners.append((n + a * right + b * up) * half)
                normals.append(n)
                uvs.append(((a + 1) / 2, (1 - b) / 2))
            triangles += [(start, start + 1, start + 2), (start, start + 2, start + 3)]
    return Surface(np.array(corners), np.array(normals), np.array(triangles), np.array(uvs))
