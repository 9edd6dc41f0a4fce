#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/mesh.h"

namespace foveray::scene {

/// Fewer triangles over the vertices of a mesh.
struct MeshLevel {
    std::vector<std::vector<std::uint32_t>> indices;  // by primitive; three a triangle
    float error = 0.0f;  // object space, metres: no point of this or of the mesh is further from the other
};

/// Levels of detail, each of about half the triangles of the one before it (the mesh itself, for the first),
/// while that makes them fewer. Primitives keep all their triangles where fewer could not show what they do:
/// with few triangles, with vertex colours, with vertices that move. Empty where all primitives do. Borders,
/// and seams of normals and texture coordinates, stay closed.
std::vector<MeshLevel> make_mesh_levels(const Mesh& mesh);

}  // namespace foveray::scene
