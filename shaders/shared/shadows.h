// The shadow stage: what of the first lights, and of the light from all round, reaches each primary surface.
#ifndef FOVERAY_SHARED_SHADOWS_H
#define FOVERAY_SHARED_SHADOWS_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

// Lights beyond these are traced where they are shaded.
FOVERAY_CONST uint MOST_KNOWN_LIGHTS = 8u;

// By light and sample: pack_visibility (light_layers.h), or one of these.
FOVERAY_CONST uint VISIBILITY_MIXED = 0x80000000u;  // flag: the samples so far disagree
FOVERAY_CONST uint VISIBILITY_NONE = 0x40000000u;   // the surface turns away from the light, or there is none

struct ShadowPush {
    uint64_t surfaces;    // Surface[]
    uint64_t scene;       // SceneData
    uint64_t noise;       // uint[BLUE_NOISE_SIZE²], see render/blue_noise.h
    uint64_t visibility;  // uint[light * sample_count + sample]
    uint64_t openness;    // float[sample]: the part of the light from all round that arrives
    uint64_t penumbras;   // uint: how many; then light * sample_count + sample of each
    uint64_t counters;    // uint[], see light_layers.h
    uint flags;           // LIGHTING_SHADOWS, LIGHTING_ADAPTIVE_SHADOWS
    uint samples;         // towards each area light
    uint occlusion_samples;
    float occlusion_radius;  // metres
    uint sample_count;
    uint light_count;   // known ones
    uint first_sample;  // of the block; its rows follow one another
    uint width;         // of the block
    uint height;
    uint wraps;          // 1: its last row is followed by its first
    uint sub_sample;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(foveray::shared::ShadowPush) == 104);
#endif

#endif
