// Light that comes by way of other surfaces, or from the environment. The including shader has `push` with scene, probes
// (ProbeField, 0: none) and environment_intensity.
#ifndef FOVERAY_RENDER_INDIRECT_GLSL
#define FOVERAY_RENDER_INDIRECT_GLSL

#include "shaders/render/environment.glsl"
#include "shaders/render/probe_field.glsl"
#include "shaders/shared/surface.h"

vec3 environment_light(vec3 direction, float roughness) {
    return push.environment_intensity * environment_radiance(SceneDataArray(push.scene).at[0].environment, direction,
                                                             roughness);
}

vec3 environment_irradiance_on(vec3 normal) {
    return push.environment_intensity * environment_irradiance(SceneDataArray(push.scene).at[0].environment, normal);
}

// Irradiance on a virtual surface by all light but the lights' own. `view` points to the viewer.
vec3 indirect_irradiance(Surface surface, vec3 view) {
    if (push.probes == 0) return environment_irradiance_on(surface.normal);
    ProbeField field = ProbeFieldArray(push.probes).at[0];
    float coverage = probe_coverage(field, surface.position);
    vec4 known = vec4(0.0);
    if (coverage > 0.0) {
        known = probe_irradiance(field, surface.position, surface.geometric_normal, surface.normal, view);
    }
    coverage *= known.w;
    if (coverage == 1.0) return known.rgb;
    return mix(environment_irradiance_on(surface.normal), known.rgb, coverage);
}

#endif
