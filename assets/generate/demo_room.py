"""Builds the demo's real room in Blender, lights it once, and renders the camera feed and the environment from it.

blender -b -noaudio -P assets/generate/demo_room.py -- CACHE light       trace the light into textures, CACHE/*.npy
blender -b -noaudio -P assets/generate/demo_room.py -- CACHE pictures    CACHE/environment.npy and CACHE/feed/%04d.png; keeps
                                                                         those that are there already

Everything in the room stands still and is matt but for a coat of gloss on some of it, so its diffuse light is traced
once, at many samples, into textures; a frame then needs few samples and carries no noise. Made with Debian's Blender 3.4.
Stage space (x, y up, z towards the wearer) is Blender's (x, -z, y).
"""

import csv
import os
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import demo_layout as layout  # noqa: E402
from noise import blurred  # noqa: E402
from room_contents import furniture, shell  # noqa: E402
from room_parts import BLENDER_FROM_STAGE, Group  # noqa: E402

BAKE_SAMPLES = int(os.environ.get("BAKE_SAMPLES", "56"))
FRAME_SAMPLES = int(os.environ.get("FRAME_SAMPLES", "4"))


def build():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    floor, walls, things = Group("floor", 1280), Group("walls", 1024), Group("things", 2048)
    shell(floor, walls)
    furniture(things)
    for group in (floor, walls, things):
        group.joined()
    world = bpy.data.worlds.new("dark")
    bpy.context.scene.world = world
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.view_settings.view_transform = "Standard"
    scene.render.threads_mode = "FIXED"
    scene.render.threads = 2
    return floor, walls, things


# --- light ----------------------------------------------------------------------------------------------------


def trace_light(groups, cache):
    scene = bpy.context.scene
    scene.cycles.samples = BAKE_SAMPLES
    scene.cycles.max_bounces = 7
    scene.cycles.diffuse_bounces = 7
    scene.cycles.sample_clamp_indirect = 4.0
    bake = scene.render.bake
    bake.use_pass_direct = bake.use_pass_indirect = True
    bake.use_pass_color = False
    bake.margin = 8
    lights = {}
    for group in groups:
        image = bpy.data.images.new(f"light {group.name}", group.size, group.size, float_buffer=True)
        image.colorspace_settings.name = "Linear"
        lights[group] = image
        for paint in group.paints:
            paint.set_up(image, traced=True)
    for group in groups:
        bpy.ops.object.select_all(action="DESELECT")
        group.objects[0].select_set(True)
        bpy.context.view_layer.objects.active = group.objects[0]
        bpy.ops.object.bake(type="DIFFUSE", margin=8, use_clear=True)
        np.save(cache / f"{group.name}.npy", smoothed(pixels_of(lights[group])[..., :3]))
        print("traced", group.name, flush=True)


def pixels_of(image):
    pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], 4)


def smoothed(light):
    """Less noise: an average over close texels that are about as bright (a bilateral filter), twice."""
    for reach, tolerance in ((3, 0.30), (2, 0.15)):
        level = np.log(np.maximum(blurred(light.mean(-1), 1.0), 1e-3))
        total, weights = np.zeros_like(light), np.zeros(light.shape[:2])
        for dy in range(-reach, reach + 1):
            for dx in range(-reach, reach + 1):
                other = np.roll(light, (dy, dx), (0, 1))
                weight = np.exp(-((np.roll(level, (dy, dx), (0, 1)) - level) ** 2) / (2 * tolerance**2))
                weight *= np.exp(-(dx * dx + dy * dy) / (2 * (reach * 0.6) ** 2))
                total += other * weight[..., None]
                weights += weight
        light = total / weights[..., None]
    return light


def show_light(groups, cache):
    for group in groups:
        light = np.load(cache / f"{group.name}.npy")
        pixels = np.ones((*light.shape[:2], 4), np.float32)
        pixels[..., :3] = light
        image = bpy.data.images.new(f"light {group.name}", group.size, group.size, float_buffer=True)
        image.colorspace_settings.name = "Linear"
        image.pixels.foreach_set(pixels.ravel())
        for paint in group.paints:
            paint.set_up(image, traced=False)
    scene = bpy.context.scene
    scene.cycles.max_bounces = 1
    scene.cycles.diffuse_bounces = 0
    scene.cycles.glossy_bounces = 1
    scene.cycles.blur_glossy = 0
    scene.cycles.sample_clamp_indirect = 3.0


# --- pictures -------------------------------------------------------------------------------------------------


def head_poses():
    with open(layout.ASSETS / "sessions" / "demo" / "head.csv") as f:
        rows = [[float(v) for v in row.values()] for row in csv.DictReader(f)]
    times = [row[0] * 1e-9 for row in rows]
    for frame in range(layout.FRAMES):
        t = frame / layout.RATE_HZ
        k = max(i for i, at in enumerate(times) if at <= t + 1e-9)
        n = min(k + 1, len(rows) - 1)
        s = 0.0 if n == k else min(max((t - times[k]) / (times[n] - times[k]), 0.0), 1.0)
        a, b = (Quaternion((rows[i][7], rows[i][4], rows[i][5], rows[i][6])) for i in (k, n))
        position = Vector(rows[k][1:4]).lerp(Vector(rows[n][1:4]), s)
        yield Matrix.Translation(position) @ a.slerp(b, s).to_matrix().to_4x4()


def add_camera(name):
    data = bpy.data.cameras.new(name)
    camera = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    data.type = "PANO"
    data.clip_start = 0.01
    return camera


def render_feed(cache, frames):
    """An equidistant fisheye: the square picture of a wide cone, of which the middle is kept."""
    scene = bpy.context.scene
    camera = add_camera("head camera")
    whole, width, height = layout.CAMERA_WHOLE, layout.CAMERA_WIDTH, layout.CAMERA_HEIGHT
    camera.data.cycles.panorama_type = "FISHEYE_EQUIDISTANT"
    camera.data.cycles.fisheye_fov = whole / layout.CAMERA_FOCAL
    scene.render.resolution_x = scene.render.resolution_y = whole
    scene.render.use_border = scene.render.use_crop_to_border = True
    scene.render.border_min_x, scene.render.border_max_x = (whole - width) / 2 / whole, (whole + width) / 2 / whole
    scene.render.border_min_y, scene.render.border_max_y = (whole - height) / 2 / whole, (whole + height) / 2 / whole
    scene.cycles.samples = FRAME_SAMPLES
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.compression = 15
    scene.render.use_persistent_data = True
    offset = Matrix.Translation(layout.CAMERA_FROM_HEAD_OFFSET)
    for frame, stage_from_head in enumerate(head_poses()):
        path = cache / "feed" / f"{frame:04d}.png"
        if frame in frames and not path.exists():
            camera.matrix_world = BLENDER_FROM_STAGE @ stage_from_head @ offset
            scene.render.filepath = str(path)
            bpy.ops.render.render(write_still=True)


def render_environment(cache):
    scene = bpy.context.scene
    camera = add_camera("environment")
    camera.data.cycles.panorama_type = "EQUIRECTANGULAR"
    camera.matrix_world = BLENDER_FROM_STAGE @ Matrix.Translation(layout.ENVIRONMENT_CENTRE)
    scene.render.resolution_x, scene.render.resolution_y = layout.ENVIRONMENT_SIZE
    scene.render.use_border = False
    scene.cycles.samples = 64
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(cache / "environment.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(cache / "environment.exr"))
    np.save(cache / "environment.npy", pixels_of(image)[::-1, :, :3])  # rows from the top


def main():
    cache, task = sys.argv[sys.argv.index("--") + 1 :]
    cache = Path(cache)
    cache.mkdir(parents=True, exist_ok=True)
    groups = build()
    if task == "light":
        trace_light(groups, cache)
        return
    show_light(groups, cache)
    render_feed(cache, [0])
    if not (cache / "environment.npy").exists():
        render_environment(cache)
    render_feed(cache, range(layout.FRAMES))


main()
