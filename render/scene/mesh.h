#pragma once

#include <string>
#include <vector>

#include <glm/gtc/type_precision.hpp>

#include "base/math.h"
#include "render/scene/ids.h"

namespace foveray::scene {

struct Aabb {
    vec3 min{1e30f};
    vec3 max{-1e30f};

    bool empty() const { return min.x > max.x; }
    vec3 center() const { return 0.5f * (min + max); }
    vec3 extent() const { return empty() ? vec3(0.0f) : max - min; }
    void add(vec3 p) { min = glm::min(min, p), max = glm::max(max, p); }
    void add(const Aabb& b) { min = glm::min(min, b.min), max = glm::max(max, b.max); }
};

/// The axis-aligned box round a transformed one.
Aabb transformed(const Aabb& box, const mat4& to_from_box);

/// Displacements that a morph weight of 1 adds. Each vector is as long as `positions` or empty (nothing
/// moves).
struct MorphTarget {
    std::vector<vec3> positions, normals, tangents;
};

/// Triangles with one material, in the mesh's own (object) space. The front side of a triangle is the one
/// from which its corners go counter-clockwise in object space, whatever the sign of its transform's
/// determinant. Every vertex array is as long as `positions` or empty where the comment allows it.
struct Primitive {
    std::vector<vec3> positions;
    std::vector<vec3> normals;   // unit
    std::vector<vec4> tangents;  // xyz unit, w = +1 or -1: bitangent = w * cross(normal, tangent); filled at
                                 // least where the material has a normal texture, else may be empty
    std::vector<vec2> uv0, uv1;  // empty: (0, 0) everywhere
    std::vector<vec4> colors;    // linear RGBA, multiplies base colour and alpha; empty: white
    std::vector<glm::u16vec4> joints;    // indices into the skin's joints; empty: not skinned
    std::vector<vec4> weights;           // sum to 1; as long as `joints`
    std::vector<std::uint32_t> indices;  // three a triangle, never empty, all below positions.size()
    std::vector<MorphTarget> morph_targets;
    MaterialId material = 0;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;  // one geometry of a BLAS each
    std::vector<float> morph_weights;   // the default weights; as many as morph targets
    Aabb bounds;                        // undeformed, object space; filled by SceneBuilder
};

}  // namespace foveray::scene
