#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "render/scene/blend.h"
#include "render/scene/mesh.h"
#include "render/scene/shape.h"

namespace foveray::scene {

struct MadeMesh;

/// A kind of triangle mesh that a formula makes, as the scene file names it.
struct MadeMeshKind {
    std::string_view name;
    std::vector<ShapeParameter> parameters;
    std::uint32_t point_width = 0;  // numbers of each of MadeMesh::points; 0: it has none
    bool has_parts = false;         // MadeMesh::parts
    /// Positions, unit normals, uv0 where it has sense, indices; counter-clockwise from the front.
    Primitive (*make)(const MadeMesh& mesh) = nullptr;
};

std::span<const MadeMeshKind> made_mesh_kinds();

/// One such mesh.
struct MadeMesh {
    const MadeMeshKind* kind = nullptr;
    std::vector<float> values;     // of the kind's parameters, one after the other
    std::vector<vec4> points;     // a profile (radius, y), a path (x, y, z, radius) or places of patches
    std::vector<BlendPart> parts;  // at least one where the kind has them

    float number(std::string_view parameter) const;
    std::uint32_t count(std::string_view parameter) const;
    vec2 pair(std::string_view parameter) const;
    vec3 triple(std::string_view parameter) const;
};

/// The same values make the same triangles, in the same order. Has vertex colours where the parameters ask
/// for veins or patterns. Without degenerate triangles; may be without any where values contradict one
/// another.
Primitive make_mesh(const MadeMesh& mesh);

}  // namespace foveray::scene
