// What intersection shaders of shapes share. The including shader declares its record as `record`, whose first member is
// `shape` (ShapeHeader).
#ifndef FOVERAY_RENDER_SHAPES_INTERSECT_GLSL
#define FOVERAY_RENDER_SHAPES_INTERSECT_GLSL

#include "shaders/render/shapes/shape_hit.glsl"
#include "shaders/shared/ray_cone.h"

hitAttributeEXT ShapeHit hit;

// Reports the surface at t, unless the ray does not see it: surface rays (which cull back faces) pass through the inner
// side of single-sided shapes. True: nothing farther need be looked for.
bool report_surface(float t, vec3 normal, bool inside, float error, uint detail) {
    bool culls = (gl_IncomingRayFlagsEXT & gl_RayFlagsCullBackFacingTrianglesEXT) != 0;
    if (inside && culls && (record.shape.flags & SHAPE_SINGLE_SIDED) != 0) return false;
    // Some drivers (Mesa's lavapipe 25) lose the nearest hit's attributes to those of a report they refuse.
    if (!(t >= gl_RayTminEXT && t <= gl_RayTmaxEXT)) return false;
    hit = ShapeHit(normal, error, detail);
    return reportIntersectionEXT(t, inside ? HIT_INSIDE : HIT_OUTSIDE);
}

#endif
