// Points that are spread evenly over a square.
#ifndef FOVERAY_RENDER_LOW_DISCREPANCY_GLSL
#define FOVERAY_RENDER_LOW_DISCREPANCY_GLSL

// Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences": R2, moved by `turn` in [0, 1)².
vec2 evenly_spread(vec2 turn, uint i) {
    uvec2 fraction = i * uvec2(3242174889u, 2447445414u);  // of 2³²: exact for any i
    return fract(turn + vec2(fraction >> 8u) / 16777216.0);
}

float greatest(vec3 v) { return max(v.r, max(v.g, v.b)); }

#endif
