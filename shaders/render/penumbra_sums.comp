#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_GOOGLE_include_directive : require

// Sums up a penumbra's samples; those that nobody wanted are as their cell's first.
#include "shaders/shared/shadows.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ShadowPush push; };

#include "shaders/render/penumbra_lists.glsl"

void main() {
    PenumbraEntries undecided = PenumbraEntries(push.undecided);
    if (gl_GlobalInvocationID.x >= undecided.list.width) return;
    uint place = undecided.at[gl_GlobalInvocationID.x], entry = PenumbraEntries(push.found).at[place];
    bool coloured = (PenumbraWords(push.cells).at[flags_word(place)] & PENUMBRA_COLOURED) != 0;
    append(push.whole, coloured, entry);
    if (coloured) return;

    Penumbra p = penumbra_at(entry);
    uint64_t lit = 0ul;
    float arrived = 0.0, sent = 0.0;
    for (uint i = 0; i < push.samples; ++i) {
        bool first = i < first_samples();
        bool traced = first || has_bit(wanted_word(place, i), i);
        bool open = traced ? has_bit(lit_word(place, i), i) : (lit & cell_of(i)) != 0ul;
        if (first && open) lit |= cell_of(i);
        float weight;
        penumbra_point(p, i, weight);
        sent += weight;
        if (open) arrived += weight;
    }
    VisibilityArray(push.visibility).at[entry] = pack_visibility(vec3(sent > 0.0 ? arrived / sent : 1.0));
}
