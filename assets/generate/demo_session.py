#!/usr/bin/env python3
"""Makes assets/sessions/demo: three seconds of a standing wearer who looks from thing to thing.

Deterministic; plain Python. Run from anywhere: python3 assets/generate/demo_session.py
"""

import bisect
import math
import random

import demo_layout as layout
import tidy_json

HEAD_HZ = 120
GAZE_HZ = 120
TAIL = 0.1  # samples go on a little past the last frame, so that interpolation never runs out

# --- vectors and quaternions (x, y, z, w) ---------------------------------------------------------------


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def unit(a):
    n = math.sqrt(sum(x * x for x in a))
    return tuple(x / n for x in a)


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def axis_angle(axis, degrees):
    h = math.radians(degrees) / 2
    return tuple(math.sin(h) * x for x in axis) + (math.cos(h),)


def multiply(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotate(q, v):
    p = multiply(multiply(q, v + (0.0,)), (-q[0], -q[1], -q[2], q[3]))
    return p[:3]


# --- head ---------------------------------------------------------------------------------------------------


def minimum_jerk(t):
    t = min(max(t, 0.0), 1.0)
    return t * t * t * (10 - 15 * t + 6 * t * t)


def ramps(t, start, moves):
    """`moves`: (time, duration, change) of minimum-jerk moves that add up."""
    return start + sum(change * minimum_jerk((t - at) / length) for at, length, change in moves)


def sway(t, seed, amplitude):
    """Postural sway: a few sines between 0.2 and 2.1 Hz with falling amplitude."""
    rng = random.Random(seed)
    total = 0.0
    for hz, weight in ((0.23, 1.0), (0.47, 0.55), (0.9, 0.3), (1.3, 0.15), (2.1, 0.06)):
        total += weight * math.sin(2 * math.pi * (hz * t + rng.random()))
    return amplitude * total


# Eye-in-stage shifts that the head follows, slower and only part of the way.
YAW_MOVES = [(0.42, 0.62, -11.0), (1.36, 0.75, 17.0), (2.20, 0.60, -9.0)]
PITCH_MOVES = [(0.40, 0.60, -3.5), (1.34, 0.70, 3.0), (2.18, 0.60, -1.0)]


def head_at(t):
    position = (
        ramps(t, -0.05, [(0.3, 1.3, 0.11), (1.7, 1.2, -0.05)]) + sway(t, 1, 0.004),
        1.52 + ramps(t, 0.0, [(0.4, 0.8, -0.018), (1.5, 0.9, 0.012)]) + sway(t, 2, 0.0015),
        ramps(t, 0.02, [(0.2, 1.4, -0.05), (1.9, 1.0, 0.03)]) + sway(t, 3, 0.004),
    )
    yaw = ramps(t, 2.0, YAW_MOVES) + sway(t, 4, 0.25)
    pitch = ramps(t, -25.0, PITCH_MOVES) + sway(t, 5, 0.2)
    roll = ramps(t, 0.0, [(0.42, 0.7, -1.2), (1.36, 0.8, 2.2), (2.2, 0.7, -1.0)]) + sway(t, 6, 0.12)
    turn = multiply(axis_angle((0, 1, 0), yaw), multiply(axis_angle((1, 0, 0), pitch), axis_angle((0, 0, 1), roll)))
    return position, turn


# --- gaze ---------------------------------------------------------------------------------------------------

vx, _, vz = layout.VASE
sx, _, sz = layout.SPHERE
kx, ky, kz = layout.KNOT

# (time at which the saccade to it starts, stage-space target). The first one is already being looked at.
FIXATIONS = [
    (-1.00, layout.VASE_EYE_CATCH),
    (0.36, (sx - 0.05, layout.SPHERE_RADIUS * 1.45, sz + layout.SPHERE_RADIUS * 0.80)),  # the chrome sphere
    (0.84, (vx + 0.68, 0.0, vz + 0.12)),  # the stand's shadow on the floor
    (1.30, (kx + 0.02, ky + 0.17, kz + 0.06)),  # the brass knot on the real table
    (1.86, (vx - 0.03, 1.02, vz + 0.07)),  # the vase's neck
    (2.32, (vx + 0.04, 0.76, vz + 0.15)),  # the painted band under the belly
    (2.72, layout.VASE_EYE_CATCH),
]
BLINK = (2.205, 2.325)  # 120 ms, around a gaze shift as blinks like to be
DRIFT = 0.0012  # radians an axis and root of a second: fixational drift, a random walk
TREMOR = 0.00012  # radians: tracker noise and tremor together


def eye_origin(t):
    position, _ = head_at(t)
    return position


def saccade_seconds(a, b):
    """Main sequence: duration = 2.2 ms a degree + 21 ms (Carpenter 1988), at least 30 ms."""
    degrees = math.degrees(math.acos(max(-1.0, min(1.0, sum(x * y for x, y in zip(a, b))))))
    return max(0.030, 0.021 + 0.0022 * degrees)


def gaze_in_stage(t):
    """Unit direction in stage space, before drift, and the index of the fixation it belongs to."""
    origin = eye_origin(t)
    index = bisect.bisect_right([start for start, _ in FIXATIONS], t) - 1
    start, target = FIXATIONS[index]
    now = unit(sub(target, origin))
    if index == 0:
        return now, index
    before = unit(sub(FIXATIONS[index - 1][1], origin))
    progress = minimum_jerk((t - start) / saccade_seconds(before, now))
    return unit(mix(before, now, progress)), index


def gaze_rows():
    rng = random.Random(20240611)
    rows = []
    drift = [0.0, 0.0]
    last_fixation = 0
    for i in range(int((layout.DURATION + TAIL) * GAZE_HZ) + 1):
        t = i / GAZE_HZ
        position, turn = head_at(t)
        stage, fixation = gaze_in_stage(t)
        if fixation != last_fixation:
            drift, last_fixation = [0.0, 0.0], fixation
        drift = [d + rng.gauss(0, DRIFT) * math.sqrt(1 / GAZE_HZ) for d in drift]
        inverse = (-turn[0], -turn[1], -turn[2], turn[3])
        x, y, z = rotate(inverse, stage)
        x += drift[0] + rng.gauss(0, TREMOR)
        y += drift[1] + rng.gauss(0, TREMOR)
        valid = not BLINK[0] <= t < BLINK[1]
        direction = unit((x, y, z)) if valid else (0.0, 0.0, -1.0)
        rows.append([time_ns(t), int(valid), 0, 0, 0, *(f"{v:.6f}" for v in direction)])
    return rows


# --- files --------------------------------------------------------------------------------------------------


def time_ns(t):
    return round(t * 1e9)


def write_csv(path, header, rows):
    path.write_text("\n".join([header, *(",".join(str(v) for v in row) for row in rows)]) + "\n")


def main():
    folder = layout.ASSETS / "sessions" / "demo"
    folder.mkdir(parents=True, exist_ok=True)
    head = []
    for i in range(int((layout.DURATION + TAIL) * HEAD_HZ) + 1):
        t = i / HEAD_HZ
        position, turn = head_at(t)
        head.append([time_ns(t), *(f"{v:.6f}" for v in position), *(f"{v:.8f}" for v in turn)])
    write_csv(folder / "head.csv", "time_ns,px,py,pz,qx,qy,qz,qw", head)
    write_csv(folder / "gaze.csv", "time_ns,valid,ox,oy,oz,dx,dy,dz", gaze_rows())
    session = {
        "format": "foveray-session",
        "version": 1,
        "units": {"time": "ns", "length": "m", "rotation": "unit quaternion"},
        "headset": "demo",
        "rate_hz": 20,
        "frames": 60,
        "scene": "../../scenes/demo.json",
        "camera": "../../feeds/demo.mp4",
        "calibration": "../../feeds/demo.calibration.json",
        "recorded": ["head", "gaze"],
    }
    tidy_json.write(folder / "session.json", session)


if __name__ == "__main__":
    main()
