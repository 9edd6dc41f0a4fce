#include "render/scene/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace foveray::scene {
namespace {

/// For each vertex a number that those at the same place share.
std::vector<std::uint32_t> places_of(const std::vector<vec3>& positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        const vec3 p = positions[i];
        return std::tuple(p.x, p.y, p.z);
    };
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::tuple(key(i), i); });
    std::vector<std::uint32_t> places(positions.size());
    std::uint32_t place = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i]) != key(order[i - 1])) ++place;
        places[order[i]] = place;
    }
    return places;
}

struct Corner {
    std::uint32_t vertex;
    vec3 normal;  // of its triangle
    float angle;
};

std::vector<Corner> corners_of(const Primitive& p) {
    std::vector<Corner> corners;
    for (std::size_t t = 0; t + 2 < p.indices.size(); t += 3) {
        const std::uint32_t* index = &p.indices[t];
        const vec3 cross = glm::cross(p.positions[index[1]] - p.positions[index[0]],
                                      p.positions[index[2]] - p.positions[index[0]]);
        const float area = glm::length(cross);
        if (!(area > 1e-12f)) continue;
        for (int k = 0; k < 3; ++k) {
            const vec3 at = p.positions[index[k]];
            const vec3 a = glm::normalize(p.positions[index[(k + 1) % 3]] - at);
            const vec3 b = glm::normalize(p.positions[index[(k + 2) % 3]] - at);
            corners.push_back({index[k], cross / area, std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f))});
        }
    }
    return corners;
}

}  // namespace

void make_smooth_normals(Primitive& p, float crease) {
    const std::vector<std::uint32_t> places = places_of(p.positions);
    const std::vector<Corner> corners = corners_of(p);
    std::vector<std::uint32_t> by_place(corners.size());
    std::iota(by_place.begin(), by_place.end(), 0u);
    std::ranges::stable_sort(by_place, {}, [&](std::uint32_t c) { return places[corners[c].vertex]; });

    const float cos_crease = std::cos(crease);
    std::vector<vec3> normals(corners.size());
    for (std::size_t first = 0, end = 0; first < by_place.size(); first = end) {
        const std::uint32_t place = places[corners[by_place[first]].vertex];
        while (end < by_place.size() && places[corners[by_place[end]].vertex] == place) ++end;
        for (std::size_t i = first; i < end; ++i) {
            vec3 sum(0.0f);
            for (std::size_t j = first; j < end; ++j) {
                const Corner& other = corners[by_place[j]];
                if (glm::dot(other.normal, corners[by_place[i]].normal) >= cos_crease || i == j) {
                    sum += other.angle * other.normal;
                }
            }
            const float length = glm::length(sum);
            normals[by_place[i]] = length > 1e-6f ? sum / length : corners[by_place[i]].normal;
        }
    }

    Primitive out;
    out.material = p.material;
    std::vector<std::vector<std::uint32_t>> copies(p.positions.size());
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const std::uint32_t v = corners[c].vertex;
        const auto same = std::ranges::find_if(copies[v], [&](std::uint32_t copy) {
            return glm::dot(out.normals[copy], normals[c]) > 0.99999f;
        });
        if (same != copies[v].end()) {
            out.indices.push_back(*same);
            continue;
        }
        copies[v].push_back(static_cast<std::uint32_t>(out.positions.size()));
        out.indices.push_back(copies[v].back());
        out.positions.push_back(p.positions[v]);
        out.normals.push_back(normals[c]);
        if (!p.uv0.empty()) out.uv0.push_back(p.uv0[v]);
        if (!p.colors.empty()) out.colors.push_back(p.colors[v]);
    }
    p = std::move(out);
}

}  // namespace foveray::scene
