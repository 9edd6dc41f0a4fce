#include "render/scene/fractal.h"

#include <algorithm>
#include <cmath>

namespace foveray::scene {
namespace {

Aabb ball_bounds(float radius) { return {vec3(-radius), vec3(radius)}; }

std::uint32_t whole(float value) { return static_cast<std::uint32_t>(std::lround(value)); }

/// Of the part of the ball at the origin where dot(normal, p) <= offset.
Aabb cut_ball_bounds(float radius, vec3 normal, float offset) {
    if (offset >= radius) return ball_bounds(radius);
    offset = std::max(offset, -radius);
    const float circle = std::sqrt(radius * radius - offset * offset);
    Aabb bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const float n = normal[axis];
        const float reach = circle * std::sqrt(std::max(0.0f, 1.0f - n * n));
        bounds.max[axis] = radius * n <= offset ? radius : offset * n + reach;
        bounds.min[axis] = -radius * n <= offset ? -radius : offset * n - reach;
    }
    return bounds;
}

}  // namespace

std::vector<ShapeParameter> julia_parameters() {
    return {{"c", 4, vec4(-0.2f, 0.6f, 0.2f, 0.2f), -2.0f, 2.0f},
            {"iterations", 1, vec4(12.0f), 1.0f, 30.0f},
            {"cut_normal", 3, vec4(0.0f), -1.0f, 1.0f},
            {"cut_offset", 1, vec4(0.0f), -10.0f, 10.0f},
            {"orbit_color", 3, vec4(1.0f), 0.0f, 1.0f}};
}

std::vector<ShapeParameter> mandelbulb_parameters() {
    return {{"power", 1, vec4(8.0f), 2.0f, 16.0f},
            {"iterations", 1, vec4(6.0f), 1.0f, 16.0f},
            {"orbit_color", 3, vec4(1.0f), 0.0f, 1.0f}};
}

Julia::Julia(std::span<const float> v)
    : c(v[0], v[1], v[2], v[3]),
      iterations(whole(v[4])),
      cut_normal(v[5], v[6], v[7]),
      cut_offset(v[8]),
      orbit_color(v[9], v[10], v[11]) {
    const float length = glm::length(cut_normal);
    cut_normal = length > 1e-6f ? cut_normal / length : vec3(0.0f);
}

float Julia::radius() const { return 0.5f + 0.5f * std::sqrt(1.0f + 4.0f * glm::length(c)); }

Mandelbulb::Mandelbulb(std::span<const float> v)
    : power(v[0]), iterations(whole(v[1])), orbit_color(v[2], v[3], v[4]) {}

float Mandelbulb::radius() const { return std::pow(2.0f, 1.0f / (power - 1.0f)); }

Aabb julia_bounds(std::span<const float> values) {
    const Julia julia(values);
    if (julia.cut_normal == vec3(0.0f)) return ball_bounds(julia.radius());
    return cut_ball_bounds(julia.radius(), julia.cut_normal, julia.cut_offset);
}

Aabb mandelbulb_bounds(std::span<const float> values) { return ball_bounds(Mandelbulb(values).radius()); }

}  // namespace foveray::scene
