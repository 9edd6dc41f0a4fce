// Light from everywhere that nothing else is: shared::Environment.
#ifndef FOVERAY_RENDER_ENVIRONMENT_GLSL
#define FOVERAY_RENDER_ENVIRONMENT_GLSL

#include "shaders/engine/textures.glsl"
#include "shaders/shared/scene.h"

// Equirectangular position of a unit vector in the picture's own frame.
vec2 equirectangular_uv(vec3 direction) {
    return vec2(0.5 + atan(direction.x, -direction.z) / 6.283185307179586,
                acos(clamp(direction.y, -1.0, 1.0)) / 3.141592653589793);
}

// Radiance from a world direction, blurred as a mirror of that perceptual roughness sees it.
vec3 environment_radiance(Environment environment, vec3 world_direction, float roughness) {
    if (environment.texture == NO_TEXTURE) return environment.constant * environment.intensity;
    vec2 uv = equirectangular_uv(normalize(environment.environment_from_world * world_direction));
    float level = clamp(roughness, 0.0, 1.0) * (environment.level_count - 1.0);
    return textureLod(textures[nonuniformEXT(environment.texture)], uv, level).rgb * environment.intensity;
}

// Irradiance on a surface with that world normal. Ramamoorthi and Hanrahan 2001, eq. 10.
vec3 environment_irradiance(Environment environment, vec3 world_normal) {
    vec3 n = environment.environment_from_world * world_normal;
    vec3 e = environment.irradiance_sh[0] * 0.28209479;
    e += environment.irradiance_sh[1] * (0.48860251 * n.y);
    e += environment.irradiance_sh[2] * (0.48860251 * n.z);
    e += environment.irradiance_sh[3] * (0.48860251 * n.x);
    e += environment.irradiance_sh[4] * (1.09254843 * n.x * n.y);
    e += environment.irradiance_sh[5] * (1.09254843 * n.y * n.z);
    e += environment.irradiance_sh[6] * (0.31539157 * (3.0 * n.z * n.z - 1.0));
    e += environment.irradiance_sh[7] * (1.09254843 * n.x * n.z);
    e += environment.irradiance_sh[8] * (0.54627422 * (n.x * n.x - n.y * n.y));
    return max(e, vec3(0.0)) * environment.intensity;
}

#endif
