#pragma once

#include <random>

#include "base/math.h"

namespace foveray::fakes {

/// A seed always gives the same numbers.
class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}

    float in(float low, float high) {
        return low + (high - low) * (static_cast<float>(engine_() >> 8) / 16777216.0f);
    }
    vec3 vector(float low, float high) { return {in(low, high), in(low, high), in(low, high)}; }
    quat rotation() { return glm::normalize(quat(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1))); }
    vec3 direction() { return rotation() * vec3(0, 0, 1); }
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(engine_() % count); }

  private:
    std::mt19937 engine_;
};

}  // namespace foveray::fakes
