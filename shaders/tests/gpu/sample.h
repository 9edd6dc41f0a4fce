// Push constants of sample.comp.
#ifndef FOVERAY_TESTS_SAMPLE_H
#define FOVERAY_TESTS_SAMPLE_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

struct SampleUse {
    uint texture;
    float u;
    float v;
    float level;
};

struct SamplePush {
    uint64_t uses;    // SampleUse[]
    uint64_t colors;  // vec4[], written
    uint count;
    uint pad;
};

FOVERAY_SHARED_END

#ifndef __cplusplus
FOVERAY_ARRAY(SampleUseArray, SampleUse);
FOVERAY_ARRAY(Vec4Array, vec4);
#endif

#endif
