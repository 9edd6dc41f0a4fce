#include "render/scene/deform.h"

#include <cmath>

namespace foveray::scene {
namespace {

template <typename Vector>
void add_targets(std::vector<Vector>& values, const Primitive& p, std::span<const float> weights,
                 std::vector<vec3> MorphTarget::*part) {
    for (std::size_t t = 0; t < p.morph_targets.size() && t < weights.size(); ++t) {
        const std::vector<vec3>& delta = p.morph_targets[t].*part;
        if (weights[t] == 0.0f || delta.empty() || values.empty()) continue;
        for (std::size_t i = 0; i < values.size(); ++i) {
            for (int c = 0; c < 3; ++c) values[i][c] += weights[t] * delta[i][c];
        }
    }
}

vec3 unit(vec3 v) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : v;
}

}  // namespace

DeformedVertices deform(const Primitive& p, std::span<const mat4> joints,
                        std::span<const float> morph_weights) {
    DeformedVertices out{p.positions, p.normals, p.tangents};
    add_targets(out.positions, p, morph_weights, &MorphTarget::positions);
    add_targets(out.normals, p, morph_weights, &MorphTarget::normals);
    add_targets(out.tangents, p, morph_weights, &MorphTarget::tangents);

    const bool skinned = !joints.empty() && !p.joints.empty();
    for (std::size_t i = 0; i < out.positions.size(); ++i) {
        mat4 world_from_object(1.0f);
        mat3 normal_matrix(1.0f);
        if (skinned) {
            world_from_object = mat4(0.0f);
            for (int k = 0; k < 4; ++k) world_from_object += p.weights[i][k] * joints[p.joints[i][k]];
            const mat3 linear(world_from_object);
            // The cofactor matrix: the inverse transpose times the determinant, and defined even when that is
            // 0.
            normal_matrix = mat3(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                 glm::cross(linear[0], linear[1]));
            if (glm::dot(linear[0], normal_matrix[0]) < 0.0f) normal_matrix = -normal_matrix;
        }
        out.positions[i] = vec3(world_from_object * vec4(out.positions[i], 1.0f));
        out.normals[i] = unit(normal_matrix * out.normals[i]);
        if (!out.tangents.empty()) {
            const vec3 t = unit(mat3(world_from_object) * vec3(out.tangents[i]));
            out.tangents[i] = vec4(t, out.tangents[i].w);
        }
    }
    return out;
}

}  // namespace foveray::scene
