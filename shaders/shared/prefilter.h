// Push constants of prefilter.comp.
#ifndef FOVERAY_SHARED_PREFILTER_H
#define FOVERAY_SHARED_PREFILTER_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

struct PrefilterPush {
    uint64_t texels;  // uvec2[height][width]: RGBA as four halves; written
    uvec2 size;
    uint source;  // texture: the equirectangular picture with its levels made by averaging
    float roughness;
    uint sample_count;
};

FOVERAY_SHARED_END

#ifndef __cplusplus
FOVERAY_ARRAY(HalfTexelArray, uvec2);
#endif

#endif
