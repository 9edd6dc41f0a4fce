#ifndef FOVERAY_EXAMPLES_PAPER_SCENE_H
#define FOVERAY_EXAMPLES_PAPER_SCENE_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

struct PaperPush {
    uint64_t pixels;  // vec3[], linear
    vec3 eye;
    vec3 light;
};

FOVERAY_SHARED_END

#endif
