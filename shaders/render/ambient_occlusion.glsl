// Short rays that look for what keeps light from all round away. The including shader has `push` (ShadowPush).
#ifndef FOVERAY_RENDER_AMBIENT_OCCLUSION_GLSL
#define FOVERAY_RENDER_AMBIENT_OCCLUSION_GLSL

#include "shaders/render/brdf.glsl"
#include "shaders/render/log_rays.glsl"
#include "shaders/render/low_discrepancy.glsl"
#include "shaders/render/surface_sides.glsl"
#include "shaders/render/trace_shadow.glsl"
#include "shaders/render/vectors.glsl"
#include "shaders/shared/surface.h"

uint occlusion_ray_count = 0;

// Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
mat3 basis_round(vec3 n) {
    float s = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (s + n.z), b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// Directions round z by their cosine.
vec3 cosine_direction(vec2 uv) {
    float radius = sqrt(uv.x), angle = 2.0 * PI * uv.y;
    return vec3(radius * cos(angle), radius * sin(angle), sqrt(1.0 - uv.x));
}

// Part of the light from all round that arrives, 0 … 1.
float ambient_visibility(Surface surface, vec2 turn) {
    if (push.occlusion_samples == 0) return 1.0;
    vec3 origin = above_surface(surface);
    mat3 basis = basis_round(surface.normal);
    RayCone cone = RayCone(surface.footprint, 0.0);
    float seen = 0.0;
    for (uint i = 0; i < push.occlusion_samples; ++i) {
        vec3 direction = basis * cosine_direction(evenly_spread(turn, i));
        // A mapped normal may send it below the surface, where nothing is to be learned.
        if (dot(direction, surface.geometric_normal) <= 0.0) direction = reflect(direction, surface.geometric_normal);
        ++occlusion_ray_count;
        log_ray(SHADOW_RAY_FLAGS, MASK_VIRTUAL, origin, direction, push.occlusion_radius, cone);
        seen += greatest(trace_shadow(MASK_VIRTUAL, origin, direction, push.occlusion_radius, cone));
    }
    return seen / float(push.occlusion_samples);
}

#endif
