// All samples of an area light's visibility, for fewer rays: where neighbouring parts of the light are seen alike, what
// lies between is taken to be seen alike too. The including shader has `push` with `flags`.
#ifndef FOVERAY_RENDER_PENUMBRA_GLSL
#define FOVERAY_RENDER_PENUMBRA_GLSL

#include "shaders/render/light_visibility.glsl"

// Cells of the light's square, a bit each, in rows of eight: 2^m of them, with more columns than rows where m is odd.
uint64_t cell_bit(uvec2 point, uint m) {
    uint column = point.x >> (32 - (m + 1) / 2), row = point.y >> (32 - m / 2);
    return 1ul << (8 * row + column);
}

uint64_t with_columns(uint64_t cells) {
    return cells | ((cells << 1) & 0xFEFEFEFEFEFEFEFEul) | ((cells >> 1) & 0x7F7F7F7F7F7F7F7Ful);
}

uint64_t with_neighbours(uint64_t cells, uint m) {
    cells = with_columns(cells);
    if (m == 5) cells = with_columns(cells);
    return cells | (cells << 8) | (cells >> 8);
}

// Columns of eight that two faces of a box have a part in.
uint64_t columns_across_faces(AreaLight area) {
    uvec2 column = min(uvec2(area.face_end.xy * 8.0), uvec2(7));
    return (0x0101010101010101ul << column.x) | (0x0101010101010101ul << column.y);
}

// As area_light_visibility. The light's square is looked at in 8 by 4 cells, then in 8 by 8, then in a cell a sample, but
// only next to where those before disagree.
vec3 penumbra_visibility(AreaLight area, Surface surface, vec2 turn, uint samples, bool mixed) {
    if (samples != 64 && samples != 256) return area_light_visibility(area, surface, turn, samples);
    uint64_t lit = 0ul, undecided = 0ul;  // of the cells before
    uint before = 0, m = samples == 64 ? 5 : 6;
    while (true) {
        bool last = 1u << m == samples;
        uint64_t now_lit = 0ul, now_dark = 0ul;
        float arrived = 0.0, sent = 0.0;
        for (uint i = 0; i < 1u << m; ++i) {
            float weight;
            vec3 target = area_light_point(area, surface.position, surface.normal, net_point(i, samples, turn), weight);
            if (weight == 0.0) continue;
            uvec2 point = net_bits(i);
            uint64_t parent = cell_bit(point, before);
            bool open = (lit & parent) != 0;
            if (before == 0 || (i >= 1u << before && (undecided & parent) != 0)) {
                vec3 through = light_through(surface, target);
                if (through != vec3(0.0) && through != vec3(1.0)) {
                    return area_light_visibility(area, surface, turn, samples);  // seen through something coloured
                }
                open = through.r > 0.0;
            }
            sent += weight;
            if (open) arrived += weight;
            if (last) continue;
            uint64_t here = cell_bit(point, m);
            if (open) {
                now_lit |= here;
            } else {
                now_dark |= here;
            }
        }
        bool agree = now_lit == 0ul || now_dark == 0ul;
        if (last || (agree && !mixed)) return vec3(sent > 0.0 ? arrived / sent : 1.0);
        undecided = ~(now_lit | now_dark) | (with_neighbours(now_lit, m) & with_neighbours(now_dark, m));
        if (area.light.type == LIGHT_BOX) undecided |= columns_across_faces(area);
        if (agree) undecided = ~0ul;
        lit = now_lit;
        before = m;
        m = m == 5 ? 6 : 8;
    }
}

#endif
