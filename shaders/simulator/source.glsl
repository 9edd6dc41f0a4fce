// Where an eye's pixels lie in a source picture, and its colour there.
#ifndef FOVERAY_SIMULATOR_SOURCE_GLSL
#define FOVERAY_SIMULATOR_SOURCE_GLSL

#include "shaders/shared/composition.h"

layout(local_size_x = COMPOSITION_GROUP, local_size_y = COMPOSITION_GROUP) in;
layout(push_constant) uniform Push { uint index; };
layout(std430, set = 0, binding = COMPOSITION_DRAWS) readonly buffer Draws { CompositionDraw draws[]; };
layout(std430, set = 0, binding = COMPOSITION_LIGHT) buffer Light { uvec2 light[]; };
layout(set = 0, binding = COMPOSITION_SOURCE) uniform sampler2D source_picture;

const float pi = 3.141592653589793;

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

// In the eye's frame, z = -1.
vec3 eye_direction(CompositionDraw draw, vec2 position) {
    vec2 part = position / vec2(draw.picture.xy);
    return vec3(mix(draw.tangents.x, draw.tangents.y, part.x), mix(draw.tangents.z, draw.tangents.w, part.y), -1.0);
}

// Samples a pixel and side for a source with `step` texels between neighbouring pixels, so that none is missed.
int samples_for(vec2 step) { return clamp(int(ceil(max(step.x, step.y) - 0.01)), 1, 8); }

// Middle of sample i of n x n, in pixels from the pixel's middle.
vec2 sample_offset(int i, int n) { return (vec2(i % n, i / n) + 0.5) / float(n) - 0.5; }

// Bilinear, without anything from outside the rectangle.
vec4 texel_at(sampler2D image, vec4 rect, vec2 uv) {
    vec2 texel = clamp(rect.xy + uv * rect.zw, rect.xy + 0.5, rect.xy + rect.zw - 0.5);
    return textureLod(image, texel / vec2(textureSize(image, 0)), 0.0);
}

#endif
