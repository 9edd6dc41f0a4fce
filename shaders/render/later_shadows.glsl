// Shadow rays that wait until all else of a sample is done: tracing one while a surface is shaded means to put away all
// that is known of the surface, which costs more than the ray. The including shader has `push` with `flags`.
#ifndef FOVERAY_RENDER_LATER_SHADOWS_GLSL
#define FOVERAY_RENDER_LATER_SHADOWS_GLSL

#include "shaders/render/light_visibility.glsl"

struct LaterShadow {
    vec3 origin;
    float width;  // of the cone at the origin
    vec3 target;
    float spread;
    vec3 radiance;  // that it decides over
};

const uint MOST_LATER_SHADOWS = 8;

LaterShadow later_shadows[MOST_LATER_SHADOWS];
uint later_shadow_count = 0;

// Of light whose way from `target` to the surface is still to be looked at. False: there is no room.
bool shadow_later(Surface surface, vec3 target, vec3 radiance) {
    if (later_shadow_count == MOST_LATER_SHADOWS || (push.flags & LIGHTING_SHADOWS) == 0) return false;
    if (dot(surface.geometric_normal, target - surface.position) <= 0.0) return true;
    RayCone cone = shadow_cone(surface);
    later_shadows[later_shadow_count++] = LaterShadow(above_surface(surface), cone.width, target, cone.spread, radiance);
    return true;
}

vec3 light_of_later_shadows() {
    vec3 sum = vec3(0.0);
    for (uint i = 0; i < later_shadow_count; ++i) {
        LaterShadow later = later_shadows[i];
        sum += later.radiance * light_between(later.origin, later.target, RayCone(later.width, later.spread));
    }
    return sum;
}

#endif
