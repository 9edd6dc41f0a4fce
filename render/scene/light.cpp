#include "render/scene/light.h"

#include <algorithm>
#include <cmath>

namespace foveray::scene {

Environment constant_environment(vec3 radiance) {
    Environment environment;
    environment.radiance = FloatImage(1, 1, 3);
    std::copy_n(&radiance.x, 3, environment.radiance.at(0, 0));
    return environment;
}

Environment default_sky() {
    constexpr std::uint32_t rows = 64;
    constexpr float zenith = 1.0f, horizon = 0.55f, ground = 0.2f;
    Environment environment;
    environment.radiance = FloatImage(1, rows, 3);
    for (std::uint32_t y = 0; y < rows; ++y) {
        const float up = std::cos(pi * (static_cast<float>(y) + 0.5f) / rows);
        const float sky = std::lerp(horizon, zenith, std::sqrt(std::max(up, 0.0f)));
        const float below = std::lerp(horizon, ground, std::min(-up * 8.0f, 1.0f));
        std::fill_n(environment.radiance.at(0, y), 3, up > 0.0f ? sky : below);
    }
    return environment;
}

vec2 environment_uv(const Environment& environment, vec3 world_direction) {
    const vec3 d = glm::normalize(world_direction);
    // Turning the picture counter-clockwise from above moves what it shows to the left.
    const float azimuth = std::atan2(d.x, -d.z) + environment.rotation;  // clockwise from -z
    const float u = 0.5f + azimuth / (2.0f * pi);
    return {u - std::floor(u), std::atan2(std::hypot(d.x, d.z), d.y) / pi};
}

}  // namespace foveray::scene
