// Four numbers in 64 bits.
#ifndef FOVERAY_SHARED_HALVES_H
#define FOVERAY_SHARED_HALVES_H

#include "shaders/shared/portable.h"

#ifdef __cplusplus
#include <glm/gtc/packing.hpp>

namespace foveray::shared {
using glm::packHalf2x16;
using glm::unpackHalf2x16;
}  // namespace foveray::shared
#endif

FOVERAY_SHARED_BEGIN

FOVERAY_CONST float LARGEST_HALF = 65504.0f;

FOVERAY_INLINE uvec2 pack_halves(vec4 v) {
    return uvec2(packHalf2x16(vec2(v.x, v.y)), packHalf2x16(vec2(v.z, v.w)));
}

FOVERAY_INLINE vec4 unpack_halves(uvec2 halves) {
    return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y));
}

FOVERAY_SHARED_END

#endif
