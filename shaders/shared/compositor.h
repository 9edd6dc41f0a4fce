// Push constants of the compositor: one view's place and what stands behind its virtual part.
#ifndef FOVERAY_SHARED_COMPOSITOR_H
#define FOVERAY_SHARED_COMPOSITOR_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint BACKGROUND_CAMERA = 0u;  // the camera picture, the environment where it does not reach
FOVERAY_CONST uint BACKGROUND_ENVIRONMENT = 1u;  // the environment, or black
FOVERAY_CONST uint BACKGROUND_RUNTIME = 2u;      // left to the headset: premultiplied colour with alpha

FOVERAY_CONST uint TONE_MAPPING_NONE = 0u;
FOVERAY_CONST uint TONE_MAPPING_NEUTRAL = 1u;

struct CompositorPush {
    // As in ViewImage.
    uint64_t resolved;
    uint64_t real;
    uint64_t color;
    uint64_t depth;
    uint64_t room;        // RoomParams
    uint64_t scene;       // SceneData, for its environment; 0: black
    vec4 stage_from_eye;  // quaternion x, y, z, w
    vec3 origin;          // of the eye in stage space
    uint background;
    vec4 tangents;  // left, right, up, down: tan of the half-angles, signs as in XrFovf
    uvec2 size;     // pixels
    float exposure;
    uint tone_mapping;
    float near_m;  // planes of the depth buffer
    float far_m;
    float environment_intensity;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(foveray::shared::CompositorPush) == 128);
#endif

#endif
