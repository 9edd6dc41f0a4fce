// One view's pixels between resolve, compositor and headset.
#ifndef FOVERAY_SHARED_VIEW_IMAGE_H
#define FOVERAY_SHARED_VIEW_IMAGE_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

// Written by resolve, read by the compositor; scene-referred and linear.
struct ResolvedPixel {
    uvec2 radiance;  // rgb of virtual things, premultiplied, and coverage, < 0 where the headset does not show the pixel:
                     // four halves (packHalf2x16)
};

// What virtual things do to the real surface behind them.
struct ResolvedRealPixel {
    uvec2 transmittance;  // rgb, halves; the fourth is unused
    uvec2 added;          // alike
};

struct ViewImage {
    uint64_t resolved;  // ResolvedPixel[height][width]
    uint64_t real;      // ResolvedRealPixel[height][width]; 0: nothing real is known, and all is as it was
    uint64_t color;     // uint[height][width]: sRGB-encoded premultiplied RGBA8, as an R8G8B8A8_SRGB image holds it
    uint64_t depth;     // float[height][width]: resolve writes metres along the view's -z axis, infinity where nothing
                        // is; the compositor makes of it 0 near … 1 far
    uvec2 size;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(ResolvedPixel) == 8 && sizeof(ResolvedRealPixel) == 16);
static_assert(sizeof(ViewImage) == 40 && offsetof(ViewImage, size) == 32);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(ResolvedPixelArray, ResolvedPixel);
FOVERAY_ARRAY(ResolvedRealPixelArray, ResolvedRealPixel);
FOVERAY_ARRAY(FloatArray, float);
#endif

#endif
