// A probe's place and state, and lookups in its maps.
#ifndef FOVERAY_RENDER_PROBE_FIELD_GLSL
#define FOVERAY_RENDER_PROBE_FIELD_GLSL

#include "shaders/shared/probes.h"

uvec3 probe_counts(ProbeField field) { return uvec3(field.count_x, field.count_y, field.count_z); }

uint probe_index(ProbeField field, uvec3 cell) {
    return (cell.z * field.count_y + cell.y) * field.count_x + cell.x;
}

vec3 probe_rest_position(ProbeField field, uint probe) {
    uint column = probe / field.count_x;
    return field.first + field.spacing * vec3(probe % field.count_x, column % field.count_y, column / field.count_y);
}

// It looks about in this frame.
bool probe_is_due(ProbeState state, uint probe, uint frame_index, uint flags) {
    if ((flags & PROBES_ALL_DUE) != 0 || (state.flags & PROBE_STARTED) == 0) return true;
    if ((state.flags & (PROBE_ASLEEP | PROBE_INSIDE)) == 0) return true;
    return (frame_index + probe) % PROBE_SLEEP_PERIOD == 0;
}

// Where a direction falls among the texels of a map: the first of four, and weights.
struct ProbeTexels {
    uint first;
    vec4 weight;  // of first, its right neighbour, and the two of the next row
};

ProbeTexels probe_texels(vec3 direction, uint side) {
    vec2 at = (octahedral_from_direction(direction) * 0.5 + 0.5) * float(side - 1);
    vec2 corner = clamp(floor(at), vec2(0.0), vec2(float(side - 2)));
    vec2 f = at - corner;
    return ProbeTexels(uint(corner.y) * side + uint(corner.x),
                       vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y));
}

vec3 probe_light(ProbeField field, uint probe, ProbeTexels t) {
    ProbeTexelArray texels = ProbeTexelArray(field.light);
    uint first = probe * PROBE_LIGHT_TEXELS + t.first;
    const uint row = PROBE_LIGHT_SIDE;
    return t.weight.x * unpack_rgb9e5(texels.at[first]) + t.weight.y * unpack_rgb9e5(texels.at[first + 1]) +
           t.weight.z * unpack_rgb9e5(texels.at[first + row]) + t.weight.w * unpack_rgb9e5(texels.at[first + row + 1]);
}

// Means of distance and of its square.
vec2 probe_depth(ProbeField field, uint probe, ProbeTexels t) {
    ProbeTexelArray texels = ProbeTexelArray(field.depth);
    uint first = probe * PROBE_DEPTH_TEXELS + t.first;
    const uint row = PROBE_DEPTH_SIDE;
    vec2 sum = vec2(0.0);
    for (uint i = 0; i < 4; ++i) {
        vec2 d = unpackHalf2x16(texels.at[first + (i & 1) + (i >> 1) * row]);
        sum += t.weight[i] * vec2(d.x, d.x * d.x + d.y * d.y);
    }
    return sum;
}

// How surely nothing stands between a probe and a point `distance` away: Chebyshev's inequality (Majercik et al. 2019,
// section 3.3), sharpened.
float probe_visibility(vec2 depth, float distance) {
    if (distance <= depth.x) return 1.0;
    float variance = max(depth.y - depth.x * depth.x, 0.0);
    float beyond = distance - depth.x;
    float part = variance / (variance + beyond * beyond);
    return max(part * part * part, 0.05);
}

// 1 within the grid's box, falling to 0 over a cell outside it.
float probe_coverage(ProbeField field, vec3 position) {
    vec3 cells = (position - field.first) / field.spacing;
    vec3 outside = max(-0.25 - cells, cells - (vec3(probe_counts(field)) - 0.75));
    return clamp(1.0 - max(outside.x, max(outside.y, outside.z)), 0.0, 1.0);
}

// Irradiance on a surface that the field covers; w: 0 when no probe can tell. `view` points to the viewer.
// Majercik et al. 2019, listing 2, with the small weights of Majercik et al. 2021, section 4.
vec4 probe_irradiance(ProbeField field, vec3 position, vec3 geometric_normal, vec3 normal, vec3 view) {
    // Off the surface, so that the surface itself is not taken for something in the way.
    float least_spacing = min(field.spacing.x, min(field.spacing.y, field.spacing.z));
    vec3 biased = position + (0.2 * geometric_normal + 0.8 * view) * (0.225 * least_spacing);
    vec3 last = vec3(probe_counts(field)) - 1.0;
    vec3 grid = clamp((biased - field.first) / field.spacing, vec3(0.0), last);
    vec3 base = min(floor(grid), max(last - 1.0, vec3(0.0)));
    vec3 between = grid - base;
    ProbeTexels texels = probe_texels(normal, PROBE_LIGHT_SIDE);
    ProbeStateArray states = ProbeStateArray(field.states);
    vec4 sum = vec4(0.0);
    for (uint i = 0; i < 8; ++i) {
        vec3 corner = vec3(i & 1, i >> 1 & 1, i >> 2);
        vec3 cell = min(base + corner, last);
        uint probe = probe_index(field, uvec3(cell));
        ProbeState state = states.at[probe];
        if ((state.flags & (PROBE_STARTED | PROBE_INSIDE)) != PROBE_STARTED) continue;
        vec3 share = mix(1.0 - between, between, corner);
        vec3 probe_position = field.first + field.spacing * cell + state.offset;
        float facing = 0.5 + 0.5 * dot(normalize(probe_position - position), normal);
        float weight = facing * facing + 0.2;
        vec3 from_probe = biased - probe_position;
        float way = length(from_probe);
        if (way > 1e-6) {
            ProbeTexels depth_texels = probe_texels(from_probe / way, PROBE_DEPTH_SIDE);
            weight *= probe_visibility(probe_depth(field, probe, depth_texels), way);
        }
        // What little is left of a hidden probe counts less still, but something where there is nothing else.
        const float little = 0.2;
        if (weight < little) weight *= weight * weight / (little * little);
        weight *= max(share.x, 1e-3) * max(share.y, 1e-3) * max(share.z, 1e-3);
        sum += weight * vec4(probe_light(field, probe, texels), 1.0);
    }
    return sum.w > 0.0 ? vec4(sum.rgb / sum.w, 1.0) : vec4(0.0);
}

#endif
