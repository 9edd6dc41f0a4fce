#include <algorithm>
#include <cmath>
#include <functional>

#include "render/scene/made_surfaces.h"

namespace foveray::scene {
namespace {

using Distance = std::function<float(vec3)>;  // below 0 inside; may be off by a factor of a few

vec3 gradient(const Distance& distance, vec3 p, float step) {
    const auto along = [&](vec3 d) { return distance(p + d) - distance(p - d); };
    return vec3(along({step, 0, 0}), along({0, step, 0}), along({0, 0, step})) / (2.0f * step);
}

/// Surface nets (Gibson 1998): a vertex in each cell that the surface crosses, drawn onto the surface, and a
/// quad across each edge of the grid that it crosses.
Primitive surface_net(const Distance& distance, const Aabb& bounds, float cell) {
    const vec3 origin = bounds.min - 1.5f * cell;
    const glm::ivec3 n = glm::ivec3(glm::ceil((bounds.max - origin) / cell)) + 2;
    const auto index = [&](int x, int y, int z) { return static_cast<std::size_t>((z * n.y + y) * n.x + x); };
    const auto at = [&](int x, int y, int z) { return origin + cell * vec3(x, y, z); };
    std::vector<float> values(static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
                              static_cast<std::size_t>(n.z));
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x) values[index(x, y, z)] = distance(at(x, y, z));
        }
    }

    Primitive p;
    std::vector<std::uint32_t> vertex(values.size(), ~0u);
    for (int z = 0; z + 1 < n.z; ++z) {
        for (int y = 0; y + 1 < n.y; ++y) {
            for (int x = 0; x + 1 < n.x; ++x) {
                vec3 sum(0.0f);
                int crossings = 0;
                for (int edge = 0; edge < 12; ++edge) {
                    const int axis = edge / 4, u = (axis + 1) % 3, v = (axis + 2) % 3;
                    glm::ivec3 a(x, y, z);
                    a[u] += edge & 1, a[v] += (edge >> 1) & 1;
                    glm::ivec3 b = a;
                    ++b[axis];
                    const float from = values[index(a.x, a.y, a.z)], to = values[index(b.x, b.y, b.z)];
                    if ((from < 0.0f) == (to < 0.0f)) continue;
                    sum += glm::mix(at(a.x, a.y, a.z), at(b.x, b.y, b.z), from / (from - to));
                    ++crossings;
                }
                if (crossings == 0) continue;
                vec3 place = sum / static_cast<float>(crossings);
                const vec3 start = place;
                for (int i = 0; i < 3; ++i) {
                    const vec3 g = gradient(distance, place, 0.1f * cell);
                    place -= g * (distance(place) / std::max(glm::dot(g, g), 1e-3f));
                }
                if (glm::length(place - start) > cell) place = start;
                const vec3 g = gradient(distance, place, 0.1f * cell);
                vertex[index(x, y, z)] = static_cast<std::uint32_t>(p.positions.size());
                p.positions.push_back(place);
                p.normals.push_back(glm::normalize(g + vec3(0.0f, 1e-12f, 0.0f)));
            }
        }
    }
    for (int z = 1; z + 1 < n.z; ++z) {
        for (int y = 1; y + 1 < n.y; ++y) {
            for (int x = 1; x + 1 < n.x; ++x) {
                for (int axis = 0; axis < 3; ++axis) {
                    glm::ivec3 b(x, y, z);
                    ++b[axis];
                    const bool inside = values[index(x, y, z)] < 0.0f;
                    if (inside == (values[index(b.x, b.y, b.z)] < 0.0f)) continue;
                    glm::ivec3 u(0), v(0);
                    u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = 1;
                    const glm::ivec3 c(x, y, z);
                    const auto corner = [&](glm::ivec3 o) { return vertex[index(o.x, o.y, o.z)]; };
                    std::uint32_t q[4] = {corner(c - u - v), corner(c - v), corner(c), corner(c - u)};
                    if (!inside) std::swap(q[1], q[3]);
                    // The shorter diagonal.
                    const bool turned = glm::distance(p.positions[q[0]], p.positions[q[2]]) >
                                        glm::distance(p.positions[q[1]], p.positions[q[3]]);
                    const int s = turned ? 1 : 0;
                    p.indices.insert(p.indices.end(),
                                     {q[s], q[s + 1], q[s + 2], q[s], q[s + 2], q[(s + 3) % 4]});
                }
            }
        }
    }
    return p;
}

float distance_to(const BlendPart& part, vec3 p) {
    const vec3 s = part.size;
    switch (part.primitive) {
        case BlendPrimitive::Box: {
            const vec3 q = glm::abs(p) - s;
            return glm::length(glm::max(q, vec3(0.0f))) + std::min(std::max({q.x, q.y, q.z}), 0.0f);
        }
        case BlendPrimitive::Torus:
            return glm::length(vec2(glm::length(vec2(p.x, p.z)) - s.x, p.y)) - s.y;
        case BlendPrimitive::Capsule:
            return glm::length(p - vec3(0.0f, std::clamp(p.y, -s.y, s.y), 0.0f)) - s.x;
        case BlendPrimitive::Sphere:
            break;
    }
    return glm::length(p) - s.x;
}

/// Polynomial smooth minimum: off by at most a quarter of k.
float smooth_least(float a, float b, float k) {
    if (k <= 0.0f) return std::min(a, b);
    const float h = std::max(k - std::abs(a - b), 0.0f) / k;
    return std::min(a, b) - 0.25f * h * h * k;
}

}  // namespace

Primitive make_blend_surface(const MadeMesh& mesh) {
    const float smoothness = mesh.number("smoothness");
    std::vector<mat4> part_from_object;
    std::vector<float> scale;
    for (const BlendPart& part : mesh.parts) {
        const vec3 s = part.object_from_part.scale;
        part_from_object.push_back(glm::inverse(to_matrix(part.object_from_part)));
        scale.push_back(std::min({s.x, s.y, s.z}));
    }
    const auto distance = [&](vec3 p) {
        float d = 1e9f;
        for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
            const float part =
                scale[i] * distance_to(mesh.parts[i], vec3(part_from_object[i] * vec4(p, 1.0f)));
            switch (mesh.parts[i].operation) {
                case BlendOperation::Union:
                    d = smooth_least(d, part, smoothness);
                    break;
                case BlendOperation::Subtract:
                    d = -smooth_least(-d, part, smoothness);
                    break;
                case BlendOperation::Intersect:
                    d = -smooth_least(-d, -part, smoothness);
                    break;
            }
        }
        return d;
    };
    const Aabb bounds = bounds_of(mesh.parts, smoothness);
    const vec3 extent = bounds.extent();
    return surface_net(distance, bounds,
                       std::max({extent.x, extent.y, extent.z}) / mesh.number("resolution"));
}

Primitive make_gyroid(const MadeMesh& mesh) {
    const float radius = mesh.number("radius"), wave = 2.0f * pi / mesh.number("cell");
    const float half_thickness = 0.5f * mesh.number("thickness");
    const auto distance = [&](vec3 p) {
        const vec3 q = wave * p;
        const float sheet = std::abs(std::sin(q.x) * std::cos(q.y) + std::sin(q.y) * std::cos(q.z) +
                                     std::sin(q.z) * std::cos(q.x)) /
                                (1.4f * wave) -
                            half_thickness;
        return -smooth_least(-sheet, radius - glm::length(p), half_thickness);
    };
    return surface_net(distance, {vec3(-radius), vec3(radius)}, 2.0f * radius / mesh.number("resolution"));
}

}  // namespace foveray::scene
