#include "render/polar_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.h"

namespace foveray::render {

shared::PolarMap make_polar_map(const Acuity& acuity, float resolution_scale, float angular_ratio) {
    assert(acuity.a > 0 && acuity.b > 0 && acuity.cap_ppd > 0 && acuity.outer_degrees > 0);
    assert(resolution_scale > 0 && angular_ratio > 0);
    shared::PolarMap map{};
    map.a = acuity.a;
    map.b = acuity.b;
    map.cap = std::min(acuity.cap_ppd, acuity.a / acuity.b);
    map.outer = acuity.outer_degrees;
    map.knee = std::clamp(acuity.a / map.cap - acuity.b, 0.0f, acuity.outer_degrees);
    map.radius_knee = map.cap * map.knee;
    map.radius_outer = shared::polar_radius(map, map.outer);
    const float width = std::ceil(map.radius_outer * resolution_scale);
    map.width = static_cast<std::uint32_t>(std::max(width, 1.0f));
    map.height = static_cast<std::uint32_t>(std::max(std::round(width * angular_ratio), 4.0f));
    return map;
}

shared::PolarMap widen_fovea(const shared::PolarMap& map, float fovea_degrees) {
    const float fovea = std::min(fovea_degrees, map.outer);
    if (fovea <= map.knee) return map;
    // Density c up to the fovea's edge f and c (f + b) / (e + b) beyond: its integral is R(outer) for one c.
    shared::PolarMap wide = map;
    wide.knee = fovea;
    const float edge = fovea + map.b;
    wide.cap = map.radius_outer / (fovea + edge * std::log((map.outer + map.b) / edge));
    wide.a = wide.cap * edge;
    wide.radius_knee = wide.cap * fovea;
    return wide;
}

float equal_density_angular_samples(const shared::PolarMap& map) {
    float most = 0.0f;
    constexpr int steps = 4096;
    for (int i = 1; i <= steps; ++i) {
        const float e = map.outer * static_cast<float>(i) / steps;
        most = std::max(most, 360.0f * std::sin(radians(e)) * shared::polar_density(map, e));
    }
    return most;
}

}  // namespace foveray::render
