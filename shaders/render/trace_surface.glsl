// Surface rays: what a ray-generation shader calls to find the nearest surface.
#ifndef FOVERAY_RENDER_TRACE_SURFACE_GLSL
#define FOVERAY_RENDER_TRACE_SURFACE_GLSL

#include "shaders/engine/scene_structure.glsl"
#include "shaders/shared/ray_cone.h"
#include "shaders/shared/ray_types.h"
#include "shaders/shared/surface.h"

layout(location = 0) rayPayloadEXT Surface surface_payload;

// `direction` has unit length. Single-sided triangles are invisible from behind, catchers are not. Only kind, flags,
// distance (< 0) and alpha (0) mean something where nothing is hit.
Surface trace_surface(uint mask, vec3 origin, vec3 direction, float t_max, RayCone cone) {
    traceRayEXT(scene_structure, gl_RayFlagsCullBackFacingTrianglesEXT, mask, RAY_SURFACE, RAY_TYPE_COUNT,
                RAY_SURFACE, origin, ray_cone_t_min(cone), direction, t_max, 0);
    return surface_payload;
}

#endif
