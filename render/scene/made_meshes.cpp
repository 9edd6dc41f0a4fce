#include <cmath>

#include "render/scene/scene_builder.h"

namespace foveray::scene {

Mesh make_rectangle(vec2 half_size_xz) {
    const auto [x, z] = std::pair(half_size_xz.x, half_size_xz.y);
    Primitive p;
    p.positions = {{-x, 0, z}, {x, 0, z}, {x, 0, -z}, {-x, 0, -z}};
    p.normals.assign(4, vec3(0, 1, 0));
    p.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    p.indices = {0, 1, 2, 0, 2, 3};
    return {.name = "rectangle", .primitives = {std::move(p)}, .morph_weights = {}, .bounds = {}};
}

Mesh make_box(vec3 half_size) {
    Primitive p;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            vec3 normal(0.0f), u(0.0f);
            normal[axis] = side;
            u[(axis + 1) % 3] = 1.0f;
            const vec3 v = glm::cross(normal, u);  // u, v, normal are right-handed
            const auto first = static_cast<std::uint32_t>(p.positions.size());
            for (const vec2 corner : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)}) {
                p.positions.push_back(half_size * (normal + corner.x * u + corner.y * v));
                p.normals.push_back(normal);
                p.uv0.push_back(0.5f + vec2(0.5f, -0.5f) * corner);
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + i);
        }
    }
    return {.name = "box", .primitives = {std::move(p)}, .morph_weights = {}, .bounds = {}};
}

Mesh make_sphere(float radius, std::uint32_t segments) {
    const std::uint32_t columns = 2 * segments, rows = segments;
    Primitive p;
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const vec2 uv(static_cast<float>(column) / static_cast<float>(columns),
                          static_cast<float>(row) / static_cast<float>(rows));
            const float azimuth = 2.0f * pi * uv.x, polar = pi * uv.y;
            const vec3 normal(std::sin(azimuth) * std::sin(polar), std::cos(polar),
                              std::cos(azimuth) * std::sin(polar));
            p.positions.push_back(radius * normal);
            p.normals.push_back(normal);
            p.uv0.push_back(uv);
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = row * (columns + 1) + column, b = a + columns + 1;
            if (row > 0) p.indices.insert(p.indices.end(), {a, b, a + 1});
            if (row + 1 < rows) p.indices.insert(p.indices.end(), {a + 1, b, b + 1});
        }
    }
    return {.name = "sphere", .primitives = {std::move(p)}, .morph_weights = {}, .bounds = {}};
}

}  // namespace foveray::scene
