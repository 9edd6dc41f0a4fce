// Push constants of the lighting stage.
#ifndef FOVERAY_SHARED_LIGHTING_H
#define FOVERAY_SHARED_LIGHTING_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint LIGHTING_SHADOWS = 1u;
FOVERAY_CONST uint LIGHTING_REFLECTIONS = 2u;

FOVERAY_CONST uint LIGHTING_DEBUG_NONE = 0u;
FOVERAY_CONST uint LIGHTING_DEBUG_NORMAL = 1u;
FOVERAY_CONST uint LIGHTING_DEBUG_ALBEDO = 2u;
FOVERAY_CONST uint LIGHTING_DEBUG_SHADOW = 3u;
FOVERAY_CONST uint LIGHTING_DEBUG_DEPTH = 4u;

struct LightingPush {
    uint64_t grid;      // SampleGrid
    uint64_t surfaces;  // Surface[]
    uint64_t samples;   // LightSample[]
    uint64_t scene;     // SceneData
    uint64_t room;      // RoomParams, or 0: no camera
    uint64_t counters;  // uint[], see light_layers.h
    uint flags;
    uint shadow_samples;  // towards each area light
    uint max_transparent_layers;
    uint debug_view;
    float reflection_max_roughness;
    float environment_intensity;
    uint first_sample;  // of the launch, whose rows follow one another
    uint pad;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(foveray::shared::LightingPush) == 80);
#endif

#endif
