// Push constants of the lighting stage.
#ifndef FOVERAY_SHARED_LIGHTING_H
#define FOVERAY_SHARED_LIGHTING_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint LIGHTING_SHADOWS = 1u;
FOVERAY_CONST uint LIGHTING_REFLECTIONS = 2u;
FOVERAY_CONST uint LIGHTING_ADAPTIVE_SHADOWS = 4u;

FOVERAY_CONST uint BLUE_NOISE_SIZE = 64u;

FOVERAY_CONST uint LIGHTING_DEBUG_NONE = 0u;
FOVERAY_CONST uint LIGHTING_DEBUG_NORMAL = 1u;
FOVERAY_CONST uint LIGHTING_DEBUG_ALBEDO = 2u;
FOVERAY_CONST uint LIGHTING_DEBUG_SHADOW = 3u;
FOVERAY_CONST uint LIGHTING_DEBUG_DEPTH = 4u;
FOVERAY_CONST uint LIGHTING_DEBUG_PROBES = 5u;

struct LightingPush {
    uint64_t grid;      // SampleGrid
    uint64_t surfaces;  // StoredSurface[]
    uint64_t samples;   // LightSample[]
    uint64_t shadowed;  // ShadowedLight[]; 0: not wanted
    uint64_t scene;     // SceneData
    uint64_t room;      // RoomParams, or 0: no camera
    uint64_t counters;  // uint[], see light_layers.h
    uint64_t noise;     // uint[BLUE_NOISE_SIZE²], see render/blue_noise.h
    uint64_t visibility;  // of the first lights: shadows.h
    uint64_t openness;
    uint64_t probes;    // ProbeField, or 0: none
    uint flags;
    uint shadow_samples;  // towards each area light
    uint max_transparent_layers;
    uint debug_view;
    float reflection_max_roughness;
    float environment_intensity;
    uint first_sample;  // of the launch, whose rows follow one another
    uint second_ray_depth;  // surfaces that reflected or refracted light has met
    uint known_lights;
    uint sample_count;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(foveray::shared::LightingPush) == 128);
#endif

#endif
