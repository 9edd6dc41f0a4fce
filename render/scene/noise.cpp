#include "render/scene/noise.h"

#include <cmath>

namespace foveray::scene {
namespace {

std::uint32_t hash(std::uint32_t x) {
    x ^= x >> 16, x *= 0x7feb352du;
    x ^= x >> 15, x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

float corner_gradient(int x, int y, int z, vec3 offset) {
    const std::uint32_t h = hash(static_cast<std::uint32_t>(x) +
                                 hash(static_cast<std::uint32_t>(y) + hash(static_cast<std::uint32_t>(z)))) &
                            15u;
    const float u = h < 8 ? offset.x : offset.y;
    const float v = h < 4 ? offset.y : (h == 12 || h == 14 ? offset.x : offset.z);
    return (h & 1 ? -u : u) + (h & 2 ? -v : v);
}

}  // namespace

float random_number(std::uint32_t seed, std::uint32_t index) {
    return static_cast<float>(hash(index + hash(seed)) >> 8) / static_cast<float>(1u << 24);
}

float gradient_noise(vec3 p) {
    const vec3 cell = glm::floor(p), f = p - cell;
    const glm::ivec3 c(cell);
    const vec3 s = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    const auto along_x = [&](int dy, int dz) {
        return glm::mix(corner_gradient(c.x, c.y + dy, c.z + dz, f - vec3(0, dy, dz)),
                        corner_gradient(c.x + 1, c.y + dy, c.z + dz, f - vec3(1, dy, dz)), s.x);
    };
    return glm::mix(glm::mix(along_x(0, 0), along_x(1, 0), s.y), glm::mix(along_x(0, 1), along_x(1, 1), s.y),
                    s.z);
}

float fractal_noise(vec3 p, int octaves) {
    float sum = 0.0f, height = 0.5f;
    for (int i = 0; i < octaves; ++i, height *= 0.5f) {
        sum += height * gradient_noise(p);
        p = 2.0f * p + vec3(17.3f, 5.1f, -11.7f);
    }
    return 2.0f * sum;
}

}  // namespace foveray::scene
