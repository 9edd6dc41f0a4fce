// Surface rays: what a ray-generation shader calls to find the nearest surface.
#ifndef FOVERAY_RENDER_TRACE_SURFACE_GLSL
#define FOVERAY_RENDER_TRACE_SURFACE_GLSL

#include "shaders/engine/scene_structure.glsl"
#include "shaders/shared/ray_types.h"
#include "shaders/shared/surface.h"

// Out: the surface. In: `footprint` holds the cone's width at the origin in metres and `distance` its spread angle in
// radians, so that the hit shaders can choose the textures' level of detail.
layout(location = 0) rayPayloadEXT Surface surface_payload;

// `direction` has unit length. Single-sided triangles are invisible from behind, catchers are not. Only kind, flags,
// distance (< 0) and alpha (0) mean something where nothing is hit.
Surface trace_surface(uint mask, vec3 origin, float t_min, vec3 direction, float t_max, float cone_width,
                      float cone_spread) {
    surface_payload.footprint = cone_width;
    surface_payload.distance = cone_spread;
    traceRayEXT(scene_structure, gl_RayFlagsCullBackFacingTrianglesEXT, mask, RAY_SURFACE, RAY_TYPE_COUNT,
                RAY_SURFACE, origin, t_min, direction, t_max, 0);
    return surface_payload;
}

#endif
