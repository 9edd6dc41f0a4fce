#pragma once

#include "render/scene/material.h"
#include "render/scene/mesh.h"

namespace foveray::scene {

/// Gives every triangle corners of its own and the triangle's normal (glTF 2.0 section 3.7.2.1: flat normals
/// where the file has none). A triangle without area gets +y.
void make_flat_normals(Primitive& primitive);

/// Tangents along +u of the texture coordinates that the normal texture uses, after its
/// KHR_texture_transform. Each corner's contribution is weighted by its angle, vertices are shared where the
/// uv map has the same handedness and split where it is mirrored, and the sum is made perpendicular to the
/// normal. This is what MikkTSpace computes, except that MikkTSpace also welds vertices that the file keeps
/// apart.
void make_tangents(Primitive& primitive, const TextureUse& normal_texture);

}  // namespace foveray::scene
