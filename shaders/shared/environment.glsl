// Light from everywhere that nothing else is.
#ifndef FOVERAY_SHARED_ENVIRONMENT_GLSL
#define FOVERAY_SHARED_ENVIRONMENT_GLSL

#include "shaders/shared/scene.h"
#include "shaders/engine/textures.glsl"

// Radiance from a direction (world, unit length). roughness 0 … 1 chooses how blurred.
vec3 environment_radiance(Environment environment, vec3 direction, float roughness) {
    if (environment.texture == NO_TEXTURE) return environment.intensity * environment.constant;
    const float pi = 3.14159265358979;
    vec3 d = environment.environment_from_world * direction;
    vec2 uv = vec2(0.5 + atan(d.x, -d.z) / (2.0 * pi), acos(clamp(d.y, -1.0, 1.0)) / pi);
    float level = roughness * (environment.level_count - 1.0);
    return environment.intensity * textureLod(textures[environment.texture], uv, level).rgb;
}

#endif
