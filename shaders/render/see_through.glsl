// Shadow rays through surfaces that let a part of the light through: for their any-hit shaders.
#ifndef FOVERAY_RENDER_SEE_THROUGH_GLSL
#define FOVERAY_RENDER_SEE_THROUGH_GLSL

#include "shaders/shared/scene.h"

layout(location = 1) rayPayloadInEXT vec4 shadow;  // trace_shadow.glsl

// The part of the light that a surface of this colour lets through: what a blended one does not cover, and the fuller
// its colour the more tinted by it; what a transmissive one transmits.
vec3 light_through(Material material, vec4 color) {
    color = clamp(color, 0.0, 1.0);
    float cover = (material.flags & MATERIAL_ALPHA_BLEND) != 0 ? color.a : 1.0;
    return (1.0 - cover) * mix(vec3(1.0), color.rgb, cover) +
           cover * material.transmission * (1.0 - material.metallic) * color.rgb;
}

// The ray goes on with this part of its light, or ends here where nothing is left.
void let_through(vec3 part) {
    shadow.rgb *= part;
    if (max(shadow.r, max(shadow.g, shadow.b)) > 0.0) ignoreIntersectionEXT;
}

#endif
