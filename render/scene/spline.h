#pragma once

#include <span>
#include <vector>

#include "base/math.h"

namespace foveray::scene {

/// About `count` points along a Catmull-Rom spline through `points`, by length; a point given twice is a
/// corner, and two points between corners are a straight line. The corners and both ends are among them.
std::vector<vec4> sample_spline(std::span<const vec4> points, std::uint32_t count);

}  // namespace foveray::scene
