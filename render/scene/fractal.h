#pragma once

#include <span>

#include "render/scene/shape.h"

namespace foveray::scene {

std::vector<ShapeParameter> julia_parameters();
std::vector<ShapeParameter> mandelbulb_parameters();

/// A quaternion Julia set: the points x + y i + z j that iterations of q -> q^2 + c leave within radius().
struct Julia {
    explicit Julia(std::span<const float> values);  // of julia_parameters()

    vec4 c;  // 1, i, j, k
    std::uint32_t iterations;
    vec3 cut_normal;   // unit length, or zero: no cut
    float cut_offset;  // what is beyond, where dot(cut_normal, p) > cut_offset, is cut off
    vec3 orbit_color;

    /// (1 + sqrt(1 + 4 |c|)) / 2: from farther away |q^2 + c| > |q|.
    float radius() const;
};

/// A Mandelbulb: the points c that iterations of z -> z^power + c, from z = c, leave within radius().
struct Mandelbulb {
    explicit Mandelbulb(std::span<const float> values);  // of mandelbulb_parameters()

    float power;
    std::uint32_t iterations;
    vec3 orbit_color;

    /// 2^(1 / (power - 1)): from farther away than this and c, |z^power + c| > |z|.
    float radius() const;
};

Aabb julia_bounds(std::span<const float> values);
Aabb mandelbulb_bounds(std::span<const float> values);

}  // namespace foveray::scene
