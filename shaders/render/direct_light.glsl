// Light straight from the scene's lights, with shadows. The including shader has `push` (LightingPush) and counts rays.
#ifndef FOVERAY_RENDER_DIRECT_LIGHT_GLSL
#define FOVERAY_RENDER_DIRECT_LIGHT_GLSL

#include "shaders/render/area_light.glsl"
#include "shaders/render/punctual_light.glsl"
#include "shaders/render/ray_origin.glsl"
#include "shaders/render/trace_shadow.glsl"
#include "shaders/shared/surface.h"

uint shadow_ray_count = 0;

struct DirectLight {
    vec3 radiance;    // reflected to the viewer
    vec3 irradiance;  // that arrives
    vec3 unshadowed;  // that would arrive if nothing virtual were in the way
};

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering": pcg2d, to [0, 1).
vec2 hash_position(uvec2 v) {
    v = v * 1664525u + 1013904223u;
    v += v.yx * 1664525u;
    v ^= v >> 16u;
    v += v.yx * 1664525u;
    v ^= v >> 16u;
    return vec2(v >> 8u) / 16777216.0;
}

// What virtual things let through from a point to another; nothing when it lies below the surface.
vec3 light_through(Surface surface, vec3 target) {
    if ((push.flags & LIGHTING_SHADOWS) == 0) return vec3(1.0);
    if (dot(surface.geometric_normal, target - surface.position) <= 0.0) return vec3(0.0);
    vec3 origin = ray_origin(surface.position, surface.position_error, surface.geometric_normal);
    vec3 way = target - origin;
    float length_of_way = length(way);
    ++shadow_ray_count;
    RayCone cone = RayCone(surface.footprint, surface.footprint / max(surface.distance, 1e-3));
    return trace_shadow(MASK_VIRTUAL, origin, way / length_of_way, length_of_way * 0.9999, cone);
}

// Part of an area light's irradiance that arrives: stratified over the light (Roberts' R2 sequence), turned by a hash
// of the sample so that penumbras are grain rather than bands, and still in a still scene.
vec3 area_light_visibility(Light light, Surface surface, uvec2 seed) {
    if ((push.flags & LIGHTING_SHADOWS) == 0) return vec3(1.0);
    vec2 turn = hash_position(seed);
    vec3 arrived = vec3(0.0);
    float sent = 0.0;
    for (uint i = 0; i < push.shadow_samples; ++i) {
        vec3 target = area_light_point(light, fract(turn + float(i) * vec2(0.7548776662, 0.5698402910)));
        vec3 way = target - surface.position;
        float distance_2 = dot(way, way);
        float weight = max(dot(surface.normal, way), 0.0) * max(-dot(cross(light.half_u, light.half_v), way), 0.0) /
                       (distance_2 * distance_2);
        if (weight == 0.0) continue;
        sent += weight;
        arrived += weight * light_through(surface, target);
    }
    return sent > 0.0 ? arrived / sent : vec3(1.0);
}

DirectLight direct_light(Surface surface, Brdf brdf, vec3 view, uvec2 seed) {
    DirectLight sum = DirectLight(vec3(0.0), vec3(0.0), vec3(0.0));
    SceneDataArray scene = SceneDataArray(push.scene);
    LightArray lights = LightArray(scene.at[0].lights);
    for (uint i = 0; i < scene.at[0].light_count; ++i) {
        Light light = lights.at[i];
        if (light.type == LIGHT_AREA) {
            vec3 irradiance = light.intensity * area_light_irradiance(light, surface.position, surface.normal);
            if (irradiance == vec3(0.0)) continue;
            vec3 arriving = area_light_visibility(light, surface, seed + uvec2(0, i));
            vec3 h = normalize(normalize(light.position - surface.position) + view);
            sum.unshadowed += irradiance;
            sum.irradiance += irradiance * arriving;
            sum.radiance += arriving * (irradiance * brdf_diffuse(brdf, clamp(dot(view, h), 0.0, 1.0)) +
                                        light.intensity * area_light_specular(light, brdf, surface.position,
                                                                              surface.normal, view));
        } else {
            LightArrival arrival = punctual_light(light, surface.position);
            vec3 irradiance = arrival.irradiance * max(dot(surface.normal, arrival.direction), 0.0);
            if (irradiance == vec3(0.0)) continue;
            vec3 arriving = light_through(surface, surface.position + arrival.distance * arrival.direction);
            sum.unshadowed += irradiance;
            sum.irradiance += irradiance * arriving;
            sum.radiance += arriving * irradiance * brdf_value(brdf, surface.normal, view, arrival.direction);
        }
    }
    return sum;
}

#endif
