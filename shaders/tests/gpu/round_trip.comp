// Copies between an array of structs and the plain words of their fields.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/shared/scene.h"
#include "shaders/tests/gpu/round_trip.h"

uint cursor;
bool to_structs;
UintArray words;

#define VISIT(Type, size, to_bits, from_bits)                              \
    void visit(inout Type x) {                                             \
        for (int i = 0; i < size; ++i, ++cursor) {                         \
            if (to_structs) {                                              \
                x[i] = from_bits(words.at[cursor]);                        \
            } else {                                                       \
                words.at[cursor] = to_bits(x[i]);                          \
            }                                                              \
        }                                                                  \
    }
VISIT(vec2, 2, floatBitsToUint, uintBitsToFloat)
VISIT(vec3, 3, floatBitsToUint, uintBitsToFloat)
VISIT(vec4, 4, floatBitsToUint, uintBitsToFloat)
VISIT(uvec2, 2, uint, uint)
VISIT(uvec4, 4, uint, uint)

void visit(inout uint x) {
    if (to_structs) {
        x = words.at[cursor];
    } else {
        words.at[cursor] = x;
    }
    ++cursor;
}

void visit(inout float x) {
    uint bits = floatBitsToUint(x);
    visit(bits);
    x = uintBitsToFloat(bits);
}

void visit(inout uint64_t x) {
    uvec2 halves = unpackUint2x32(x);
    visit(halves);
    x = packUint2x32(halves);
}

void visit(inout mat3 x) {
    for (int i = 0; i < 3; ++i) visit(x[i]);
}

void visit(inout mat4 x) {
    for (int i = 0; i < 4; ++i) visit(x[i]);
}

void visit(inout mat4x3 x) {
    for (int i = 0; i < 4; ++i) visit(x[i]);
}

#include "struct_fields.h"

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform Push { RoundTripPush push; };

void main() {
    words = UintArray(push.words);
    to_structs = push.to_structs != 0;
    cursor = gl_GlobalInvocationID.x * push.words_per_struct;
    visit_struct(push.which, push.structs, gl_GlobalInvocationID.x, to_structs);
}
