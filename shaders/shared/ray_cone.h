// A ray's cone, which chooses every level of detail. Intersection shaders see no payload, but they see the ray: its
// t_min carries the cone, as a number so small that it moves nothing.
#ifndef FOVERAY_SHARED_RAY_CONE_H
#define FOVERAY_SHARED_RAY_CONE_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

struct RayCone {
    float width;   // at the ray's origin, metres
    float spread;  // full angle, radians: width grows by it a metre
};

// Widths and spreads are kept as logarithms in steps of 0.24 %, from 2^-26 (also for 0) to 4.
FOVERAY_CONST float RAY_CONE_LEAST_LOG = -26.0f;
FOVERAY_CONST float RAY_CONE_LOG_STEPS = 8191.0f / 28.0f;
FOVERAY_CONST uint RAY_CONE_FIRST = 0x2B800000u;  // bits of 2^-40; 26 bits more stay below 2^-32

FOVERAY_INLINE uint ray_cone_log(float value) {
    float steps = (log2(max(value, 1e-12f)) - RAY_CONE_LEAST_LOG) * RAY_CONE_LOG_STEPS;
    return uint(clamp(steps + 0.5f, 0.0f, 8191.0f));
}

FOVERAY_INLINE float ray_cone_value(uint steps) {
    return steps == 0u ? 0.0f : exp2(float(steps) / RAY_CONE_LOG_STEPS + RAY_CONE_LEAST_LOG);
}

// t_min of a ray with this cone: more than 0, less than 3e-10.
FOVERAY_INLINE float ray_cone_t_min(RayCone cone) {
    return uintBitsToFloat(RAY_CONE_FIRST + (ray_cone_log(cone.width) << 13) + ray_cone_log(cone.spread));
}

FOVERAY_INLINE RayCone ray_cone_of(float t_min) {
    uint bits = floatBitsToUint(t_min) - RAY_CONE_FIRST;
    RayCone cone;
    cone.width = ray_cone_value(bits >> 13 & 8191u);
    cone.spread = ray_cone_value(bits & 8191u);
    return cone;
}

FOVERAY_INLINE float ray_cone_width(RayCone cone, float distance) { return cone.width + cone.spread * distance; }

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(RayCone) == 8 && offsetof(RayCone, spread) == 4);
}  // namespace foveray::shared
#endif

#endif
