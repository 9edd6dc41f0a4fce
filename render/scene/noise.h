#pragma once

#include <cstdint>

#include "base/math.h"

namespace foveray::scene {

/// Uniform in 0..1, by the numbers alone.
float random_number(std::uint32_t seed, std::uint32_t index);
/// Smooth noise in -1..1, about one bump a metre; 0 at whole numbers (Perlin 2002).
float gradient_noise(vec3 p);
/// Octaves of it, each half as wide and half as high, in about -1..1.
float fractal_noise(vec3 p, int octaves);

}  // namespace foveray::scene
