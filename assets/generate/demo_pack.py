#!/usr/bin/env python3
"""Turns what demo_room.py rendered into assets: CACHE/feed/*.png to feeds/demo.mp4, CACHE/environment.npy to
environments/demo_room.hdr. Needs python3-numpy and ffmpeg.

/usr/bin/python3 assets/generate/demo_pack.py CACHE
"""

import subprocess
import sys
from pathlib import Path

import numpy as np

import demo_layout as layout

# The roof window is the scene's area light, which brings its light; in the environment it only has to look white.
BRIGHTEST = 2.0


def write_hdr(path, radiance):
    """Radiance RGBE, run-length format with literal runs; rows from the top."""
    height, width, _ = radiance.shape
    peak = radiance.max(-1)
    mantissa, exponent = np.frexp(np.maximum(peak, 1e-32))
    scale = np.where(peak > 1e-32, mantissa * 256.0 / np.maximum(peak, 1e-32), 0.0)
    rgbe = np.zeros((height, width, 4), np.uint8)
    rgbe[..., :3] = np.clip(radiance * scale[..., None], 0, 255)
    rgbe[..., 3] = np.where(peak > 1e-32, exponent + 128, 0)
    with open(path, "wb") as f:
        f.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode())
        for row in rgbe:
            f.write(bytes((2, 2, width >> 8, width & 255)))
            for channel in range(4):
                for start in range(0, width, 128):
                    run = row[start : start + 128, channel].tobytes()
                    f.write(bytes((len(run),)) + run)


def main():
    cache = Path(sys.argv[1])
    environment = layout.ASSETS / "environments" / "demo_room.hdr"
    environment.parent.mkdir(exist_ok=True)
    write_hdr(environment, np.clip(np.load(cache / "environment.npy"), 0, BRIGHTEST))
    feed = layout.ASSETS / "feeds" / "demo.mp4"
    feed.parent.mkdir(exist_ok=True)
    subprocess.run(
        [
            "ffmpeg",
            "-y",
            "-loglevel",
            "error",
            "-framerate",
            str(layout.RATE_HZ),
            "-i",
            str(cache / "feed" / "%04d.png"),
        ]
        + [
            "-frames:v",
            str(layout.FRAMES),
            "-c:v",
            "libx264",
            "-preset",
            "veryslow",
            "-crf",
            "19",
            "-pix_fmt",
            "yuv420p",
        ]
        + ["-colorspace", "smpte170m", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv"]
        + ["-movflags", "+faststart", "-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact", str(feed)],
        check=True,
    )
    for path in (environment, feed):
        print(f"{path.name}: {path.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
