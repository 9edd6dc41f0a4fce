// Point, spot and directional lights: KHR_lights_punctual.
#ifndef FOVERAY_RENDER_PUNCTUAL_LIGHT_GLSL
#define FOVERAY_RENDER_PUNCTUAL_LIGHT_GLSL

#include "shaders/shared/scene.h"

struct LightArrival {
    vec3 direction;   // to the light, unit length
    float distance;   // metres
    vec3 irradiance;  // on a surface that faces the light
};

LightArrival punctual_light(Light light, vec3 position) {
    LightArrival arrival;
    if (light.type == LIGHT_DIRECTIONAL) {
        arrival.direction = -light.direction;
        arrival.distance = 1e6;
        arrival.irradiance = light.intensity;
        return arrival;
    }
    vec3 to_light = light.position - position;
    arrival.distance = max(length(to_light), 1e-4);
    arrival.direction = to_light / arrival.distance;
    float attenuation = 1.0 / (arrival.distance * arrival.distance);
    if (light.range > 0.0) {
        float part = arrival.distance / light.range;
        attenuation *= clamp(1.0 - part * part * part * part, 0.0, 1.0);
    }
    if (light.type == LIGHT_SPOT) {
        float cosine = dot(light.direction, -arrival.direction);
        float inside = clamp((cosine - light.cos_outer) / max(light.cos_inner - light.cos_outer, 1e-3), 0.0, 1.0);
        attenuation *= inside * inside;
    }
    arrival.irradiance = light.intensity * attenuation;
    return arrival;
}

#endif
