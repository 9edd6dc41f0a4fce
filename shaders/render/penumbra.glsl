// Surfaces that may lie in a light's penumbra, and the lists of them. The including shader has `push` (ShadowPush).
#ifndef FOVERAY_RENDER_PENUMBRA_GLSL
#define FOVERAY_RENDER_PENUMBRA_GLSL

#include "shaders/render/area_light.glsl"
#include "shaders/render/low_discrepancy.glsl"
#include "shaders/render/shadows.glsl"
#include "shaders/render/still_noise.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PenumbraEntries {
    PenumbraList list;
    uint at[];
};

struct Penumbra {
    uint index;  // of the sample
    Surface surface;
    AreaLight area;
    vec2 turn;
};

Light light_of_entry(uint entry) { return LightArray(SceneDataArray(push.scene).at[0].lights).at[entry / push.sample_count]; }

// `entry`: light * sample_count + sample.
Penumbra penumbra_at(uint entry) {
    Penumbra p;
    p.index = entry % push.sample_count;
    uint in_block = p.index - push.first_sample;
    vec2 turn = still_noise(push.noise, uvec2(in_block % push.width, in_block / push.width), 0, push.sub_sample);
    Light light = light_of_entry(entry);
    p.turn = evenly_spread(turn, 7 * light.number);
    p.surface = surface_of(SurfaceArray(push.surfaces).at[p.index]);
    p.area = area_light_at(light, p.surface.position, p.surface.normal);
    return p;
}

vec3 penumbra_point(Penumbra p, uint i, out float weight) {
    return area_light_point(p.area, p.surface.position, p.surface.normal, net_point(i, push.samples, p.turn), weight);
}

uint first_samples() { return 1u << penumbra_first_level(push.samples); }

FOVERAY_ARRAY(PenumbraWords, uint);

// Of a place in the list of those found.
uint flags_word(uint place) { return place * penumbra_words(push.samples); }
uint lit_word(uint place, uint i) { return flags_word(place) + 1 + i / 32; }
uint wanted_word(uint place, uint i) { return lit_word(place, push.samples) + (i - first_samples()) / 32; }

bool has_bit(uint word, uint i) { return (PenumbraWords(push.cells).at[word] >> (i % 32) & 1) != 0; }

// Cells of the light's square, a bit each, in rows of eight: as many as first samples, with more columns than rows where
// that is no square number.
uint64_t cell_of(uint i) {
    uint level = penumbra_first_level(push.samples);
    uvec2 point = net_bits(i);
    return 1ul << (8 * (point.y >> (32 - level / 2)) + (point.x >> (32 - (level + 1) / 2)));
}

#endif
