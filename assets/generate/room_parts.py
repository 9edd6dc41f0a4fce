"""What the demo's room is made of in Blender: paints, and shapes gathered into groups that share a light texture.

Shapes are made in stage space (x, y up, z towards the wearer), which is Blender's (x, -z, y).
"""

import math

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector

BLENDER_FROM_STAGE = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


class Paint:
    """A matt surface, perhaps under a coat of gloss. `albedo`: linear colour, or (picture, metres a repeat)."""

    def __init__(self, name, albedo, gloss=0.0, roughness=0.3, glow=None, grain=0.0):
        self.name, self.albedo, self.gloss, self.roughness, self.glow, self.grain = (
            name,
            albedo,
            gloss,
            roughness,
            glow,
            grain,
        )
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self.material.cycles.sample_as_light = glow is not None

    def _albedo_socket(self, tree):
        nodes, links = tree.nodes, tree.links
        if isinstance(self.albedo, tuple) and isinstance(self.albedo[0], bpy.types.Image):
            image, repeat = self.albedo
            uv = nodes.new("ShaderNodeUVMap")
            uv.uv_map = "metres"
            scale = nodes.new("ShaderNodeMapping")
            scale.inputs["Scale"].default_value = (1 / repeat[0], 1 / repeat[1], 1)
            links.new(uv.outputs[0], scale.inputs[0])
            texture = nodes.new("ShaderNodeTexImage")
            texture.image = image
            links.new(scale.outputs[0], texture.inputs[0])
            return texture.outputs[0]
        colour = nodes.new("ShaderNodeRGB")
        colour.outputs[0].default_value = (*self.albedo, 1)
        if not self.grain:
            return colour.outputs[0]
        uv = nodes.new("ShaderNodeUVMap")
        uv.uv_map = "metres"
        speckle = nodes.new("ShaderNodeTexNoise")
        speckle.inputs["Scale"].default_value = 260
        speckle.inputs["Detail"].default_value = 2
        links.new(uv.outputs[0], speckle.inputs[0])
        ramp = nodes.new("ShaderNodeMapRange")
        ramp.inputs["To Min"].default_value = 1 - self.grain
        ramp.inputs["To Max"].default_value = 1 + self.grain
        links.new(speckle.outputs["Fac"], ramp.inputs["Value"])
        scaled = nodes.new("ShaderNodeVectorMath")
        scaled.operation = "SCALE"
        links.new(colour.outputs[0], scaled.inputs[0])
        links.new(ramp.outputs[0], scaled.inputs["Scale"])
        return scaled.outputs[0]

    def set_up(self, light, traced):
        """`traced`: for tracing light into `light`; otherwise shows what was traced."""
        tree = self.material.node_tree
        nodes, links = tree.nodes, tree.links
        nodes.clear()
        out = nodes.new("ShaderNodeOutputMaterial")
        if self.glow:
            shine = nodes.new("ShaderNodeEmission")
            shine.inputs[0].default_value = (*self.glow, 1)
            links.new(shine.outputs[0], out.inputs[0])
        elif traced:
            matt = nodes.new("ShaderNodeBsdfDiffuse")
            links.new(self._albedo_socket(tree), matt.inputs[0])
            links.new(matt.outputs[0], out.inputs[0])
        uv = nodes.new("ShaderNodeUVMap")
        uv.uv_map = "light"
        texture = nodes.new("ShaderNodeTexImage")
        texture.image = light
        texture.extension = "EXTEND"
        links.new(uv.outputs[0], texture.inputs[0])
        nodes.active = texture  # what Blender bakes into
        if self.glow or traced:
            return
        lit = nodes.new("ShaderNodeVectorMath")
        lit.operation = "MULTIPLY"
        links.new(self._albedo_socket(tree), lit.inputs[0])
        links.new(texture.outputs[0], lit.inputs[1])
        shine = nodes.new("ShaderNodeEmission")
        links.new(lit.outputs[0], shine.inputs[0])
        if not self.gloss:
            links.new(shine.outputs[0], out.inputs[0])
            return
        coat = nodes.new("ShaderNodeBsdfGlossy")
        coat.inputs["Roughness"].default_value = self.roughness
        fresnel = nodes.new("ShaderNodeFresnel")
        fresnel.inputs[0].default_value = 1.45
        weight = nodes.new("ShaderNodeMath")
        weight.operation = "MULTIPLY"
        weight.inputs[1].default_value = self.gloss
        links.new(fresnel.outputs[0], weight.inputs[0])
        blend = nodes.new("ShaderNodeMixShader")
        links.new(weight.outputs[0], blend.inputs[0])
        links.new(shine.outputs[0], blend.inputs[1])
        links.new(coat.outputs[0], blend.inputs[2])
        links.new(blend.outputs[0], out.inputs[0])


def picture(name, srgb):
    """A Blender image from rows (top first) x columns x 3, encoded as sRGB."""
    rows, columns = srgb.shape[:2]
    image = bpy.data.images.new(name, columns, rows)
    pixels = np.ones((rows, columns, 4), np.float32)
    pixels[..., :3] = srgb[::-1]
    image.pixels.foreach_set(pixels.ravel())
    image.pack()
    return image


# --- geometry -------------------------------------------------------------------------------------------------


class Group:
    """Things that share one light texture."""

    def __init__(self, name, size):
        self.name, self.size, self.objects, self.paints = name, size, [], []

    def add(self, mesh_data, paint, smooth=False):
        """`mesh_data`: a bmesh in stage space."""
        mesh = bpy.data.meshes.new(self.name)
        mesh_data.normal_update()
        for face in mesh_data.faces:
            face.smooth = smooth
        layer = mesh_data.loops.layers.uv.new("metres")
        for face in mesh_data.faces:  # projected along the axis that the face looks along most
            n = [abs(c) for c in face.normal]
            axis = n.index(max(n))
            for loop in face.loops:
                x, y, z = loop.vert.co
                loop[layer].uv = ((z, y), (x, z), (x, y))[axis]
        mesh_data.transform(BLENDER_FROM_STAGE)
        mesh_data.to_mesh(mesh)
        mesh_data.free()
        mesh.materials.append(paint.material)
        if paint not in self.paints:
            self.paints.append(paint)
        thing = bpy.data.objects.new(self.name, mesh)
        bpy.context.collection.objects.link(thing)
        self.objects.append(thing)
        return thing

    def joined(self):
        bpy.ops.object.select_all(action="DESELECT")
        for thing in self.objects:
            thing.select_set(True)
        bpy.context.view_layer.objects.active = self.objects[0]
        if len(self.objects) > 1:
            bpy.ops.object.join()
        thing = bpy.context.view_layer.objects.active
        self.objects = [thing]
        thing.data.uv_layers.new(name="light")
        thing.data.uv_layers.active = thing.data.uv_layers["light"]
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.smart_project(angle_limit=math.radians(60), island_margin=0.0018)
        bpy.ops.object.mode_set(mode="OBJECT")
        return thing


def box(low, high, bevel=0.0, segments=2, turn=0.0, puff=0.0):
    """Axis-aligned from corner to corner, then turned by `turn` degrees about its upright axis; `puff` swells cushions."""
    low, high = Vector(low), Vector(high)
    made = bmesh.new()
    bmesh.ops.create_cube(made, size=1)
    bmesh.ops.scale(made, vec=high - low, verts=made.verts)
    if puff:
        bmesh.ops.subdivide_edges(made, edges=made.edges, cuts=7, use_grid_fill=True)
        half = (high - low) / 2
        for v in made.verts:
            u = [v.co[i] / half[i] for i in range(3)]
            for i in range(3):
                others = [u[j] for j in range(3) if j != i]
                v.co[i] *= 1 + puff * ((1 - others[0] ** 2) * (1 - others[1] ** 2) - 0.55)
    if bevel:
        edges = [e for e in made.edges if e.calc_face_angle(0) > 0.8]
        bmesh.ops.bevel(
            made, geom=edges, offset=bevel, segments=segments, profile=0.5, affect="EDGES", clamp_overlap=True
        )
    bmesh.ops.rotate(made, cent=(0, 0, 0), matrix=Matrix.Rotation(math.radians(turn), 3, "Y"), verts=made.verts)
    bmesh.ops.translate(made, vec=(low + high) / 2, verts=made.verts)
    return made


def pillow(width, height, thickness, cells=18):
    """Centred at the origin, its thin side along z; pinched at the corners, its sides drawn in a little."""
    made = bmesh.new()
    sides = []
    for sign in (1, -1):
        rows = []
        for i in range(cells + 1):
            row = []
            for k in range(cells + 1):
                u, v = 2 * k / cells - 1, 2 * i / cells - 1
                pull = 1 - 0.10 * (1 - v * v) * u * u, 1 - 0.10 * (1 - u * u) * v * v
                full = ((1 - u**4) * (1 - v**4)) ** 0.55
                rim = i in (0, cells) or k in (0, cells)
                if rim and sign < 0:
                    row.append(sides[0][i][k])
                else:
                    row.append(
                        made.verts.new((u * pull[0] * width / 2, v * pull[1] * height / 2, sign * full * thickness / 2))
                    )
            rows.append(row)
        sides.append(rows)
        for i in range(cells):
            for k in range(cells):
                corners = [rows[i][k], rows[i][k + 1], rows[i + 1][k + 1], rows[i + 1][k]]
                made.faces.new(corners if sign > 0 else corners[::-1])
    return made


def quad(*corners):
    made = bmesh.new()
    made.faces.new([made.verts.new(c) for c in corners])
    return made


def oblong(start, end, across, side, depth, bevel=0.004):
    """A bar from `start` to `end`, `side` wide along the unit vector `across` and `depth` deep."""
    start, end, across = Vector(start), Vector(end), Vector(across)
    along = end - start
    made = box((-side / 2, -depth / 2, 0), (side / 2, depth / 2, along.length), bevel)
    z = along.normalized()
    y = z.cross(across)
    made.transform(Matrix.Translation(start) @ Matrix((across, y, z)).transposed().to_4x4())
    return made


def turned(profile, centre, segments=48):
    """A profile of (radius, height), from the top down, round an upright axis."""
    made = bmesh.new()
    rings = []
    for radius, height in profile:
        rings.append(
            [
                made.verts.new((centre[0] + radius * math.sin(a), centre[1] + height, centre[2] + radius * math.cos(a)))
                for a in (2 * math.pi * i / segments for i in range(segments))
            ]
        )
    for upper, lower in zip(rings, rings[1:]):
        for i in range(segments):
            k = (i + 1) % segments
            made.faces.new((upper[i], lower[i], lower[k], upper[k]))
    return made
