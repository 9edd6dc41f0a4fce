#pragma once

#include <cstdint>
#include <vector>

namespace foveray::render {

/// Pairs of values in [0, 1) on a square that repeats, each evenly distributed and each as different from its
/// neighbours' as can be: Ulichney 1993, "The void-and-cluster method for dither array generation". Row by
/// row, a pair as two 16-bit fractions, the first in the low half. The same in every run.
std::vector<std::uint32_t> make_blue_noise(std::uint32_t size);

}  // namespace foveray::render
