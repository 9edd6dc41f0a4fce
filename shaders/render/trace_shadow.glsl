// Shadow rays: what a ray-generation shader calls to find how much light passes between two points.
#ifndef FOVERAY_RENDER_TRACE_SHADOW_GLSL
#define FOVERAY_RENDER_TRACE_SHADOW_GLSL

#include "shaders/engine/scene_structure.glsl"
#include "shaders/shared/ray_cone.h"
#include "shaders/shared/ray_types.h"

// Transmittance; w: 1 when nothing opaque stood in the way, which the miss shader says.
layout(location = 1) rayPayloadEXT vec4 shadow_payload;

const uint SHADOW_RAY_FLAGS = gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT;

// 1: nothing in between, 0: something opaque. `direction` has unit length. Triangles block light from both sides.
vec3 trace_shadow(uint mask, vec3 origin, vec3 direction, float t_max, RayCone cone) {
    shadow_payload = vec4(1.0, 1.0, 1.0, 0.0);
    traceRayEXT(scene_structure, SHADOW_RAY_FLAGS, mask, RAY_SHADOW, RAY_TYPE_COUNT, RAY_SHADOW, origin,
                ray_cone_t_min(cone), direction, t_max, 1);
    return shadow_payload.rgb * shadow_payload.w;
}

#endif
