// One level of an environment's roughness chain. A thread a texel. Karis 2013, "Real Shading in Unreal Engine 4",
// with the view along the normal; samples read a level as coarse as their share of the lobe: Křivánek and Colbert
// 2008, "Real-time Shading with Filtered Importance Sampling", eq. 11-13.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/render/environment.glsl"
#include "shaders/shared/prefilter.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform PushBlock { PrefilterPush push; };

const float pi = 3.141592653589793;

vec3 direction_of(vec2 uv) {
    float azimuth = (uv.x - 0.5) * 2.0 * pi, polar = uv.y * pi;
    return vec3(sin(polar) * sin(azimuth), cos(polar), -sin(polar) * cos(azimuth));
}

void main() {
    uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, push.size))) return;
    vec3 n = direction_of((vec2(texel) + 0.5) / vec2(push.size));
    vec3 side = abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 t = normalize(cross(side, n));
    vec3 b = cross(n, t);
    float alpha = push.roughness * push.roughness;
    vec2 source_size = vec2(textureSize(textures[push.source], 0));

    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (uint i = 0; i < push.sample_count; ++i) {
        // Hammersley points, GGX half vectors.
        vec2 xi = vec2((float(i) + 0.5) / float(push.sample_count), float(bitfieldReverse(i)) * 2.3283064365386963e-10);
        float cos2 = (1.0 - xi.x) / (1.0 + (alpha * alpha - 1.0) * xi.x);
        float cosine = sqrt(cos2), sine = sqrt(max(0.0, 1.0 - cos2));
        vec3 h = sine * cos(2.0 * pi * xi.y) * t + sine * sin(2.0 * pi * xi.y) * b + cosine * n;
        vec3 l = 2.0 * cosine * h - n;
        float n_l = dot(n, l);
        if (n_l <= 0.0) continue;
        float d = cos2 * (alpha * alpha - 1.0) + 1.0;
        float density = alpha * alpha / (pi * d * d) / 4.0;  // of l, where view = n
        float sample_angle = 1.0 / (float(push.sample_count) * density);
        float texel_angle =
            2.0 * pi * pi / (source_size.x * source_size.y) * max(sqrt(1.0 - min(1.0, l.y * l.y)), 1e-3);
        float level = max(0.0, 0.5 * log2(sample_angle / texel_angle) + 1.0);
        sum += n_l * textureLod(textures[push.source], equirectangular_uv(l), level).rgb;
        weight += n_l;
    }
    vec3 radiance = min(sum / max(weight, 1e-6), vec3(65504.0));
    HalfTexelArray(push.texels).at[texel.y * push.size.x + texel.x] =
        uvec2(packHalf2x16(radiance.rg), packHalf2x16(vec2(radiance.b, 1.0)));
}
