#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_GOOGLE_include_directive : require

// What the first samples of a penumbra tell: where neighbouring cells of the light are seen alike, what lies between is
// taken to be seen alike too; the samples in other cells are wanted.
#include "shaders/shared/shadows.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ShadowPush push; };

#include "shaders/render/penumbra_lists.glsl"

uint64_t with_columns(uint64_t cells) {
    return cells | ((cells << 1) & 0xFEFEFEFEFEFEFEFEul) | ((cells >> 1) & 0x7F7F7F7F7F7F7F7Ful);
}

// As far to each side as up and down, also where there are more columns than rows.
uint64_t with_neighbours(uint64_t cells) {
    cells = with_columns(cells);
    if (penumbra_first_level(push.samples) % 2 == 1) cells = with_columns(cells);
    return cells | (cells << 8) | (cells >> 8);
}

// Columns that two faces of a box have a part in.
uint64_t columns_across_faces(AreaLight area) {
    uvec2 column = min(uvec2(area.face_end.xy * 8.0), uvec2(7));
    return (0x0101010101010101ul << column.x) | (0x0101010101010101ul << column.y);
}

void main() {
    uint place = gl_GlobalInvocationID.x;
    PenumbraEntries found = PenumbraEntries(push.found);
    if (place >= found.list.width) return;
    uint entry = found.at[place];
    PenumbraWords words = PenumbraWords(push.cells);
    bool coloured = (words.at[flags_word(place)] & PENUMBRA_COLOURED) != 0;
    append(push.whole, coloured, entry);
    if (coloured) return;

    Penumbra p = penumbra_at(entry);
    uint64_t lit = 0ul, dark = 0ul;
    for (uint i = 0; i < first_samples(); ++i) {
        float weight;
        penumbra_point(p, i, weight);
        if (weight == 0.0) continue;
        if (has_bit(lit_word(place, i), i)) {
            lit |= cell_of(i);
        } else {
            dark |= cell_of(i);
        }
    }
    bool agree = lit == 0ul || dark == 0ul;
    bool mixed = VisibilityArray(push.visibility).at[entry] == VISIBILITY_MIXED;
    bool settled = agree && !mixed && (lit | dark) != 0ul;
    append(push.undecided, !settled, place);
    if (settled) {
        VisibilityArray(push.visibility).at[entry] = pack_visibility(vec3(dark == 0ul ? 1.0 : 0.0));
        return;
    }
    uint64_t undecided = ~(lit | dark) | (with_neighbours(lit) & with_neighbours(dark));
    if (agree) undecided = ~0ul;
    if (p.area.light.type == LIGHT_BOX) undecided |= columns_across_faces(p.area);
    for (uint i = first_samples(); i < push.samples; i += 32) {
        uint wanted = 0;
        for (uint bit = 0; bit < 32; ++bit) {
            if ((undecided & cell_of(i + bit)) != 0ul) wanted |= 1u << bit;
        }
        words.at[wanted_word(place, i)] = wanted;
    }
}
