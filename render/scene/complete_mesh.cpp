#include "render/scene/complete_mesh.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>

namespace foveray::scene {
namespace {

/// vertices[i] becomes vertices[from[i]] in every array of the primitive.
void gather_vertices(Primitive& p, std::span<const std::uint32_t> from) {
    const auto gather = [&](auto& values) {
        if (values.empty()) return;
        std::remove_reference_t<decltype(values)> gathered;
        gathered.reserve(from.size());
        for (const std::uint32_t i : from) gathered.push_back(values[i]);
        values = std::move(gathered);
    };
    gather(p.positions), gather(p.normals), gather(p.tangents), gather(p.uv0), gather(p.uv1);
    gather(p.colors), gather(p.joints), gather(p.weights);
    for (MorphTarget& target : p.morph_targets) {
        gather(target.positions), gather(target.normals), gather(target.tangents);
    }
}

vec3 any_perpendicular(vec3 n) {
    return glm::normalize(glm::cross(n, std::abs(n.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0)));
}

vec3 normalize_or(vec3 v, vec3 fallback) {
    const float length = glm::length(v);
    return length > 1e-20f ? v / length : fallback;
}

float angle_between(vec3 a, vec3 b) {
    return std::acos(std::clamp(glm::dot(normalize_or(a, vec3(0)), normalize_or(b, vec3(0))), -1.0f, 1.0f));
}

}  // namespace

void make_flat_normals(Primitive& p) {
    p.tangents.clear();  // of no use without the normals they belong to
    for (MorphTarget& target : p.morph_targets) target.normals.clear(), target.tangents.clear();
    gather_vertices(p, p.indices);
    p.normals.resize(p.positions.size());
    for (std::uint32_t i = 0; i < p.indices.size(); ++i) p.indices[i] = i;
    for (std::size_t i = 0; i + 2 < p.positions.size(); i += 3) {
        const vec3 normal =
            normalize_or(glm::cross(p.positions[i + 1] - p.positions[i], p.positions[i + 2] - p.positions[i]),
                         vec3(0, 1, 0));
        std::fill_n(p.normals.begin() + static_cast<std::ptrdiff_t>(i), 3, normal);
    }
}

void make_tangents(Primitive& p, const TextureUse& normal_texture) {
    const std::vector<vec2>& uvs = normal_texture.uv_set == 0 ? p.uv0 : p.uv1;
    const mat3 transform = uv_matrix(normal_texture);
    const auto vertices = static_cast<std::uint32_t>(p.positions.size());
    const auto uv = [&](std::uint32_t i) {
        return uvs.empty() ? vec2(0.0f) : vec2(transform * vec3(uvs[i], 1.0f));
    };

    // One sum for each handedness: [0, n) is +1, [n, 2n) is -1.
    std::vector<vec3> sums(2 * std::size_t{vertices}, vec3(0.0f));
    std::vector<bool> used(2 * std::size_t{vertices}, false);
    std::vector<std::uint32_t> corners(p.indices.size());
    for (std::size_t t = 0; t < p.indices.size(); t += 3) {
        const std::uint32_t* index = &p.indices[t];
        const vec3 e1 = p.positions[index[1]] - p.positions[index[0]];
        const vec3 e2 = p.positions[index[2]] - p.positions[index[0]];
        const vec2 d1 = uv(index[1]) - uv(index[0]), d2 = uv(index[2]) - uv(index[0]);
        const float area = d1.x * d2.y - d1.y * d2.x;
        // v grows downwards and the bitangent points up in the picture: a map seen from its front has area <
        // 0.
        const std::uint32_t side = area > 0.0f ? vertices : 0;
        const vec3 direction = (area < 0.0f ? -1.0f : 1.0f) * (e1 * d2.y - e2 * d1.y);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = index[k];
            const vec3 n = p.normals[v];
            const vec3 in_plane = direction - n * glm::dot(n, direction);
            const float angle = angle_between(p.positions[index[(k + 1) % 3]] - p.positions[v],
                                              p.positions[index[(k + 2) % 3]] - p.positions[v]);
            sums[v + side] += angle * normalize_or(in_plane, vec3(0.0f));
            used[v + side] = true;
            corners[t + static_cast<std::size_t>(k)] = v + side;
        }
    }

    // Vertices with both handednesses get a twin at the end.
    std::vector<std::uint32_t> from(vertices), place(2 * std::size_t{vertices});
    std::vector<float> sign(vertices, 1.0f);
    for (std::uint32_t v = 0; v < vertices; ++v) {
        from[v] = v;
        place[v] = place[v + vertices] = v;
        if (!used[v]) sign[v] = -1.0f;
        if (used[v] && used[v + vertices]) {
            place[v + vertices] = static_cast<std::uint32_t>(from.size());
            from.push_back(v);
            sign.push_back(-1.0f);
        }
    }
    gather_vertices(p, from);
    for (std::size_t i = 0; i < corners.size(); ++i) p.indices[i] = place[corners[i]];
    p.tangents.resize(from.size());
    for (std::size_t v = 0; v < from.size(); ++v) {
        const vec3 sum = sums[from[v] + (sign[v] < 0.0f ? vertices : 0)];
        const vec3 n = p.normals[v];
        p.tangents[v] = vec4(normalize_or(sum - n * glm::dot(n, sum), any_perpendicular(n)), sign[v]);
    }
}

}  // namespace foveray::scene
