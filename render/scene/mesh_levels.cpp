#include "render/scene/mesh_levels.h"

#include <algorithm>
#include <meshoptimizer.h>

namespace foveray::scene {
namespace {

constexpr std::size_t least_triangles = 2000;  // of a primitive: below it levels do not repay their memory
constexpr std::size_t most_levels = 4;
// meshoptimizer's error is the root of a mean square over the triangles that a corner stood for. The greatest
// distance was at most 2.9 times as much over the shipped meshes (tests/reference/mesh_levels_test.cpp).
constexpr float greatest_over_mean = 4.0f;

bool can_be_simplified(const Primitive& p) {
    const bool one_color = std::ranges::all_of(p.colors, [&](vec4 c) { return c == p.colors.front(); });
    return p.indices.size() / 3 >= least_triangles && p.joints.empty() && p.morph_targets.empty() &&
           one_color;
}

struct Simplified {
    std::vector<std::uint32_t> indices;
    float error = 0.0f;
};

Simplified half_of(const Primitive& p, const std::vector<std::uint32_t>& indices) {
    const float* positions = &p.positions.front().x;
    const std::size_t target = indices.size() / 6 * 3;
    Simplified result{std::vector<std::uint32_t>(indices.size())};
    float error = 0.0f;
    result.indices.resize(meshopt_simplify(result.indices.data(), indices.data(), indices.size(), positions,
                                           p.positions.size(), sizeof(vec3), target, 1.0f,
                                           meshopt_SimplifyLockBorder, &error));
    result.error = error * meshopt_simplifyScale(positions, p.positions.size(), sizeof(vec3));
    return result;
}

std::size_t index_count(const MeshLevel& level) {
    std::size_t count = 0;
    for (const auto& indices : level.indices) count += indices.size();
    return count;
}

}  // namespace

std::vector<MeshLevel> make_mesh_levels(const Mesh& mesh) {
    MeshLevel last;
    for (const Primitive& p : mesh.primitives) last.indices.push_back(p.indices);
    std::vector<MeshLevel> levels;
    while (levels.size() < most_levels) {
        MeshLevel next = last;
        float error = 0.0f;
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            if (!can_be_simplified(mesh.primitives[i])) continue;
            Simplified half = half_of(mesh.primitives[i], last.indices[i]);
            if (half.indices.empty()) continue;
            next.indices[i] = std::move(half.indices);
            error = std::max(error, half.error);
        }
        next.error = last.error + greatest_over_mean * error;
        if (index_count(next) > index_count(last) / 4 * 3) break;
        levels.push_back(next);
        last = std::move(next);
    }
    return levels;
}

}  // namespace foveray::scene
