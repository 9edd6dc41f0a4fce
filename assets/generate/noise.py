"""Gradient noise over numpy arrays, and pictures derived from height fields."""

import numpy as np


def _hash(ix, iy, iz, seed):
    ix, iy, iz = np.broadcast_arrays(*(np.atleast_1d(i) for i in (ix, iy, iz)))  # scalars would warn of overflow
    h = (ix.astype(np.uint32) * np.uint32(0x9E3779B1)) ^ (iy.astype(np.uint32) * np.uint32(0x85EBCA77))
    h ^= (iz.astype(np.uint32) * np.uint32(0xC2B2AE3D)) ^ np.uint32(seed * 0x27D4EB2F & 0xFFFFFFFF)
    h ^= h >> np.uint32(15)
    h *= np.uint32(0x2C1B3C6D)
    h ^= h >> np.uint32(12)
    h *= np.uint32(0x297A2D39)
    return h ^ (h >> np.uint32(15))


def random(ix, iy, iz, seed=0):
    """0..1 for integer coordinates."""
    value = _hash(ix, iy, iz, seed) / np.float64(2**32)
    return value if np.ndim(ix) or np.ndim(iy) or np.ndim(iz) else float(value[0])


def noise(x, y, z=0.0, seed=0, period_x=None):
    """Perlin's gradient noise, about -1..1. `period_x`: repeats after that many units of x (an integer)."""
    x, y, z = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float), np.asarray(z, float))
    fx, fy, fz = np.floor(x), np.floor(y), np.floor(z)
    dx, dy, dz = x - fx, y - fy, z - fz
    sx, sy, sz = (d * d * d * (d * (d * 6 - 15) + 10) for d in (dx, dy, dz))
    total = np.zeros(x.shape)
    for i in (0, 1):
        ix = fx + i
        if period_x:
            ix = np.mod(ix, period_x)
        for j in (0, 1):
            for k in (0, 1):
                h = _hash(ix.astype(np.int64), (fy + j).astype(np.int64), (fz + k).astype(np.int64), seed)
                gx = (h & 1023) / 511.5 - 1
                gy = ((h >> np.uint32(10)) & 1023) / 511.5 - 1
                gz = ((h >> np.uint32(20)) & 1023) / 511.5 - 1
                weight = (sx if i else 1 - sx) * (sy if j else 1 - sy) * (sz if k else 1 - sz)
                total += weight * (gx * (dx - i) + gy * (dy - j) + gz * (dz - k))
    return total * 1.3


def fractal(x, y, z=0.0, octaves=4, seed=0, period_x=None):
    total, amplitude, scale = 0.0, 1.0, 1
    for octave in range(octaves):
        period = period_x * scale if period_x else None
        total = total + amplitude * noise(x * scale, y * scale, np.asarray(z) * scale, seed + octave, period)
        amplitude *= 0.5
        scale *= 2
    return total


def smoothstep(a, b, x):
    t = np.clip((x - a) / (b - a), 0, 1)
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    return a + (b - a) * t


def to_srgb(linear):
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.power(np.maximum(linear, 1e-9), 1 / 2.4) - 0.055)


def to_linear(srgb):
    srgb = np.asarray(srgb, float)
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def normal_map(height, texel_x, texel_y):
    """Tangent-space normals, encoded 0..1, y up in the picture. `height` and texel sizes in metres; wraps in x."""
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) / (2 * texel_x)
    dy = np.gradient(height, axis=0) / texel_y
    n = np.stack([-dx, dy, np.ones_like(height)], -1)  # rows grow downwards, so up is -row
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    return n * 0.5 + 0.5


def blurred(image, radius):
    """Gaussian blur with standard deviation `radius` pixels; wraps in x, clamps in y."""
    reach = int(3 * radius + 1)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / radius) ** 2)
    kernel /= kernel.sum()
    padded = np.pad(image, ((0, 0), (reach, reach)), mode="wrap")
    image = sum(k * padded[:, i : i + image.shape[1]] for i, k in enumerate(kernel))
    padded = np.pad(image, ((reach, reach), (0, 0)), mode="edge")
    return sum(k * padded[i : i + image.shape[0]] for i, k in enumerate(kernel))
