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

// A list and the size of the launch over it, which is the beginning of VkTraceRaysIndirectCommandKHR: `width` is how
// many there are. Entries follow.
struct PenumbraList {
    uint width;
    uint height;
    uint depth;
    uint pad;
};

// Where 64 or 256 samples of a light are asked for, some are taken first, and of the rest those that neighbouring ones
// disagree about. How many first, as a power of two; 0: not of such a count.
FOVERAY_INLINE uint penumbra_first_level(uint samples) { return samples == 64u ? 5u : samples == 256u ? 6u : 0u; }

// A penumbra's words: flags; a bit a sample: it is lit; a bit a later sample: it is to be traced.
FOVERAY_CONST uint PENUMBRA_COLOURED = 1u;  // flag: light came through something coloured

FOVERAY_INLINE uint penumbra_lit_words(uint samples) { return samples / 32u; }

FOVERAY_INLINE uint penumbra_words(uint samples) {
    return 1u + 2u * penumbra_lit_words(samples) - (1u << (penumbra_first_level(samples) - 5u));
}

FOVERAY_CONST uint SHADOWS_LATER_SAMPLES = 8u;  // ShadowPush::flags: trace the samples that are wanted, not the first

struct ShadowPush {
    uint64_t surfaces;    // StoredSurface[]
    uint64_t scene;       // SceneData
    uint64_t noise;       // uint[BLUE_NOISE_SIZE²], see render/blue_noise.h
    uint64_t visibility;  // uint[light * sample_count + sample]
    uint64_t openness;    // float[sample]: the part of the light from all round that arrives
    uint64_t found;       // PenumbraList of light * sample_count + sample: what may lie in a penumbra
    uint64_t undecided;   // PenumbraList of places in `found`: what needs more than the first samples
    uint64_t whole;       // PenumbraList as `found`: what is sampled in one go
    uint64_t cells;       // uint[place in `found`][penumbra_words]; 0: all goes to `whole`
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
static_assert(sizeof(foveray::shared::ShadowPush) == 128);
#endif

#endif
