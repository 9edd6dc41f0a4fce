#version 450
#extension GL_GOOGLE_include_directive : require

// The layers over what is behind them, as it goes to the display.
#include "shaders/simulator/source.glsl"

layout(std430, set = 0, binding = COMPOSITION_BYTES) writeonly buffer Bytes { uint bytes[]; };

vec2 environment_place(CompositionDraw draw, vec2 position) {
    vec3 d = normalize(rotate(draw.source.source_from_eye, eye_direction(draw, position)));
    return vec2(0.5 + atan(d.x, -d.z) / (2.0 * pi), acos(clamp(d.y, -1.0, 1.0)) / pi);
}

// The environment wraps round its left and right edges, where the sampler repeats.
vec3 environment(CompositionDraw draw, vec2 middle) {
    vec2 size = vec2(textureSize(source_picture, 0));
    vec2 place = environment_place(draw, middle);
    vec2 dx = environment_place(draw, middle + vec2(1.0, 0.0)) - place;
    vec2 dy = environment_place(draw, middle + vec2(0.0, 1.0)) - place;
    dx.x -= round(dx.x);
    dy.x -= round(dy.x);
    int n = samples_for(vec2(length(dx * size), length(dy * size)));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < n * n; ++i) {
        vec2 at = environment_place(draw, middle + sample_offset(i, n));
        at.y = clamp(at.y, 0.5 / size.y, 1.0 - 0.5 / size.y);
        sum += textureLod(source_picture, at, 0.0).rgb;
    }
    return sum / float(n * n);
}

vec3 filling_picture(CompositionDraw draw, vec2 middle) {
    vec2 size = vec2(textureSize(source_picture, 0)), shown = vec2(draw.picture.xy);
    float texels = min(size.x / shown.x, size.y / shown.y);  // a pixel
    vec2 corner = 0.5 * (size - texels * shown);
    int n = samples_for(vec2(texels));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < n * n; ++i) {
        vec2 texel = corner + texels * (middle + sample_offset(i, n));
        sum += textureLod(source_picture, clamp(texel, vec2(0.5), size - 0.5) / size, 0.0).rgb;
    }
    return sum / float(n * n);
}

vec3 background(CompositionDraw draw, vec2 middle) {
    if (draw.what.x == COMPOSITION_ENVIRONMENT) return environment(draw, middle);
    if (draw.what.x == COMPOSITION_PICTURE) return filling_picture(draw, middle);
    return draw.scale.rgb;
}

vec3 srgb_from_linear(vec3 color) {
    color = clamp(color, 0.0, 1.0);
    return mix(1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, 12.92 * color, lessThanEqual(color, vec3(0.0031308)));
}

void main() {
    CompositionDraw draw = draws[index];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, draw.picture.xy))) return;
    uint at = pixel.y * draw.picture.x + pixel.x;
    vec4 shown = vec4(unpackHalf2x16(light[at].x), unpackHalf2x16(light[at].y));
    float passed = draw.what.y == COMPOSITION_BLEND_OPAQUE     ? 0.0
                   : draw.what.y == COMPOSITION_BLEND_ADDITIVE ? 1.0
                                                               : 1.0 - shown.a;
    if (passed > 0.0) shown.rgb += passed * background(draw, vec2(pixel) + 0.5);
    bytes[draw.picture.z + at] = packUnorm4x8(vec4(srgb_from_linear(shown.rgb), 1.0));
}
