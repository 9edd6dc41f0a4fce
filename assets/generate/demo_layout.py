"""Where things stand in the demo, shared by every generator, so that session, scene, feed and environment agree.

Stage space: metres, right-handed, y up, -z forward; the real floor is y = 0 and the wearer stands near the origin.
"""

import math
from pathlib import Path

ASSETS = Path(__file__).resolve().parent.parent

RATE_HZ = 30
FRAMES = 90
DURATION = FRAMES / RATE_HZ

# Virtual objects (assets/scenes/demo.json): where each one's foot stands.
VASE = (-0.02, 0.0, -1.45)
VASE_EYE_CATCH = (0.02, 0.86, -1.31)  # the painted flower that faces the wearer
TABLE_TOP = ((-1.06, 0.44, -1.82), (-0.50, 0.48, -1.26))  # opposite corners of the real side table's top
KNOT = (-0.78, 0.48, -1.54)
SPHERE_RADIUS = 0.21
SPHERE = (0.50, 0.0, -1.28)
FLOAT_RADIUS = 0.11
FLOAT = (-0.36, 0.0, -1.08)
POT = (0.17, 0.0, -1.04)

# The real room: walls, and the roof window that lights it (the scene's one area light).
ROOM_X = (-2.0, 2.4)
ROOM_Z = (-3.6, 1.7)
KNEE_WALL_HEIGHT = 1.30
CEILING_HEIGHT = 2.75
SLOPE_END_X = -0.70  # the sloping ceiling rises from the knee wall to here
WINDOW_CENTRE_S = 0.55  # middle of the window, as a fraction of the slope from the knee wall up
WINDOW_Z = -2.05
WINDOW_ALONG = 0.80  # metres along the slope
WINDOW_ACROSS = 1.10  # metres along z
WINDOW_RADIANCE = (25.0, 26.8, 29.0)  # camera white is 1

CAMERA_FROM_HEAD_OFFSET = (0.0, -0.01, -0.05)  # head_from_camera translation


def slope_frame():
    """Unit vector up the slope, the slope's normal into the room, and the slope's length."""
    dx = SLOPE_END_X - ROOM_X[0]
    dy = CEILING_HEIGHT - KNEE_WALL_HEIGHT
    length = math.hypot(dx, dy)
    along = (dx / length, dy / length, 0.0)
    normal = (along[1], -along[0], 0.0)
    return along, normal, length


def window_centre():
    along, _, length = slope_frame()
    s = WINDOW_CENTRE_S * length
    return (ROOM_X[0] + along[0] * s, KNEE_WALL_HEIGHT + along[1] * s, WINDOW_Z)


def window_pane():
    """Middle of the lit rectangle, just inside the slope."""
    _, normal, _ = slope_frame()
    return tuple(c + 0.012 * n for c, n in zip(window_centre(), normal))


# The head camera of the recorded feed: an equidistant fisheye, cut from the middle of a wider square picture.
CAMERA_WIDTH, CAMERA_HEIGHT = 1024, 880
CAMERA_FOCAL = 540.0  # pixels a radian
CAMERA_WHOLE = 1360  # side of that square

ENVIRONMENT_CENTRE = (0.0, 0.55, -1.35)
ENVIRONMENT_SIZE = (512, 256)
