// Where rays that leave a surface start.
#ifndef FOVERAY_RENDER_SURFACE_SIDES_GLSL
#define FOVERAY_RENDER_SURFACE_SIDES_GLSL

#include "shaders/render/ray_origin.glsl"
#include "shaders/shared/surface.h"

vec3 above_surface(Surface surface) {
    return ray_origin(surface.position, surface.position_error, surface.geometric_normal);
}

// `position` may be in front of the true surface by its error, so that only from as far behind it the surface is not
// met again.
vec3 below_surface(Surface surface) {
    float beyond = surface.position_error + min(surface.position_error, 0.5 * surface.footprint);
    return ray_origin(surface.position, beyond, -surface.geometric_normal);
}

// Of a ray that goes straight on.
vec3 behind_surface(Surface surface, vec3 direction) {
    return surface.thickness > 0.0 ? surface.position + surface.thickness * direction : below_surface(surface);
}

#endif
