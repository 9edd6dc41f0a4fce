// One view's pixels between resolve, compositor and headset.
#ifndef FOVERAY_SHARED_VIEW_IMAGE_H
#define FOVERAY_SHARED_VIEW_IMAGE_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

// Written by resolve, read by the compositor; scene-referred and linear.
struct ResolvedPixel {
    uvec2 radiance;       // rgb of virtual things, premultiplied, and coverage: four halves (packHalf2x16)
    uvec2 transmittance;  // rgb; the fourth half is 1 where the pixel is visible in the headset
    uvec2 added;          // rgb; the fourth half is unused
    float depth;          // metres along the view's -z axis; infinity where nothing is
};

struct ViewImage {
    uint64_t resolved;  // ResolvedPixel[height][width]
    uint64_t color;     // uint[height][width]: sRGB-encoded premultiplied RGBA8, as an R8G8B8A8_SRGB image holds it
    uint64_t depth;     // float[height][width]: 0 near … 1 far
    uvec2 size;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(ResolvedPixel) == 28 && offsetof(ResolvedPixel, depth) == 24);
static_assert(sizeof(ViewImage) == 32 && offsetof(ViewImage, size) == 24);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(ResolvedPixelArray, ResolvedPixel);
FOVERAY_ARRAY(FloatArray, float);
#endif

#endif
