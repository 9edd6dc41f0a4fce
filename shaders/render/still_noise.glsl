// Noise that belongs to a place in the sample grid, not to the scene: it stays where it is in the eye's view.
#ifndef FOVERAY_RENDER_STILL_NOISE_GLSL
#define FOVERAY_RENDER_STILL_NOISE_GLSL

#include "shaders/render/low_discrepancy.glsl"
#include "shaders/shared/lighting.h"

FOVERAY_ARRAY(NoiseArray, uint);

// Two values in [0, 1) that differ from those of neighbouring cells as far as can be. Different dimensions are
// independent; further samples of the same cell continue the sequence.
vec2 still_noise(uint64_t noise, uvec2 cell, uint dimension, uint sub_sample) {
    uvec2 place = (cell + uvec2(29, 47) * dimension) % BLUE_NOISE_SIZE;
    vec2 value = unpackUnorm2x16(NoiseArray(noise).at[place.y * BLUE_NOISE_SIZE + place.x]);
    return evenly_spread(value, 4097 * sub_sample);
}

#endif
