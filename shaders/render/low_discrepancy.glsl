// Points that are spread evenly over a square.
#ifndef FOVERAY_RENDER_LOW_DISCREPANCY_GLSL
#define FOVERAY_RENDER_LOW_DISCREPANCY_GLSL

// Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences": R2, moved by `turn` in [0, 1)².
vec2 evenly_spread(vec2 turn, uint i) {
    uvec2 fraction = i * uvec2(3242174889u, 2447445414u);  // of 2³²: exact for any i
    return fract(turn + vec2(fraction >> 8u) / 16777216.0);
}

// Sobol's first two dimensions as fractions of 2³²: of the first 4^k points one lies in each cell of a grid of 2^k by 2^k.
uvec2 net_bits(uint i) {
    uint y = 0;
    for (uint direction = 1u << 31, rest = i; rest != 0; rest >>= 1, direction ^= direction >> 1) {
        if ((rest & 1u) != 0) y ^= direction;
    }
    return uvec2(bitfieldReverse(i), y);
}

// Into how many cells to a side, as a power of two, `count` points divide the square alike.
uint net_level(uint count) { return uint(findLSB(count)) / 2; }

// Point i of `count`, moved within its cell by `turn` in [0, 1)².
vec2 net_point(uint i, uint count, vec2 turn) {
    uvec2 moved = net_bits(i) ^ (uvec2(turn * 65536.0) << 16u >> net_level(count));
    return vec2(moved >> 8u) / 16777216.0;
}

#endif
