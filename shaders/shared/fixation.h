// Push constants and state of the fixation stage: where the gaze meets the scene.
#ifndef FOVERAY_SHARED_FIXATION_H
#define FOVERAY_SHARED_FIXATION_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

// Kept from frame to frame on the GPU.
struct FixationState {
    float inverse_distance;  // 1/m along the gaze ray, smoothed
};

struct FixationPush {
    uint64_t grid;         // SampleGrid, for the eyes
    uint64_t gaze_frames;  // GazeFrame[2], written
    uint64_t state;        // FixationState
    vec3 origin;           // of the gaze ray, world
    float far_distance;    // metres, taken where the gaze meets nothing
    vec3 direction;        // world, unit length
    float blend;           // 0 … 1: share of this frame's measurement in the state
};

FOVERAY_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(foveray::shared::FixationPush) == 56);
#else
FOVERAY_ARRAY(FixationStateArray, FixationState);
#endif

#endif
