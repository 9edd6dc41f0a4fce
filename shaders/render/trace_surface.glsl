// Surface rays: what a ray-generation shader calls to find the nearest surface.
#ifndef FOVERAY_RENDER_TRACE_SURFACE_GLSL
#define FOVERAY_RENDER_TRACE_SURFACE_GLSL

#include "shaders/engine/scene_structure.glsl"
#include "shaders/shared/ray_cone.h"
#include "shaders/shared/ray_types.h"
#include "shaders/shared/surface.h"

layout(location = 0) rayPayloadEXT Surface surface_payload;

// Whether single-sided triangles are seen from behind too. Catchers always are.
const uint SEE_FRONT_FACES = gl_RayFlagsCullBackFacingTrianglesEXT;
const uint SEE_BOTH_FACES = gl_RayFlagsNoneEXT;

// `direction` has unit length. Only kind, flags, distance (< 0) and alpha (0) mean something where nothing is hit.
Surface trace_surface(uint mask, uint faces, vec3 origin, vec3 direction, float t_max, RayCone cone) {
    traceRayEXT(scene_structure, faces, mask, RAY_SURFACE, RAY_TYPE_COUNT, RAY_SURFACE, origin, ray_cone_t_min(cone),
                direction, t_max, 0);
    return surface_payload;
}

Surface trace_surface(uint mask, vec3 origin, vec3 direction, float t_max, RayCone cone) {
    return trace_surface(mask, SEE_FRONT_FACES, origin, direction, t_max, cone);
}

#endif
