// Light straight from the scene's lights, with shadows. The including shader has `push` with `flags` and `scene`.
#ifndef FOVERAY_RENDER_DIRECT_LIGHT_GLSL
#define FOVERAY_RENDER_DIRECT_LIGHT_GLSL

#include "shaders/render/light_visibility.glsl"
#include "shaders/render/later_shadows.glsl"
#include "shaders/render/shadows.glsl"

struct DirectLight {
    vec3 radiance;    // reflected to the viewer
    vec3 irradiance;  // that arrives
    vec3 unshadowed;  // that would arrive if nothing virtual were in the way
    // The same of lights whose shadows are noisy alone, and `radiance` as if nothing were in the way.
    vec3 soft;
    vec3 soft_open;
    vec3 soft_irradiance;
    vec3 soft_unshadowed;
};

// How the shadows on a surface are found: of the first `known` lights they are in memory.
struct ShadowSource {
    vec2 turn;            // in [0, 1)²: which points of area lights are looked at
    uint samples;         // how many
    uint known;
    uint64_t visibility;  // as ShadowPush::visibility, from this surface's sample on
    uint stride;          // from light to light
    vec3 later;           // above 0: shadow rays may be traced later, and their light counts for so much
};

ShadowSource traced_shadows(vec2 turn, uint samples) { return ShadowSource(turn, samples, 0, 0ul, 0, vec3(0.0)); }

DirectLight direct_light(Surface surface, Brdf brdf, vec3 view, ShadowSource shadows) {
    DirectLight sum = DirectLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    SceneDataArray scene = SceneDataArray(push.scene);
    LightArray lights = LightArray(scene.at[0].lights);
    for (uint i = 0; i < scene.at[0].light_count; ++i) {
        Light light = lights.at[i];
        vec3 arriving = vec3(1.0);
        if (i < shadows.known) {
            uint found = VisibilityArray(shadows.visibility).at[i * shadows.stride];
            if (found == VISIBILITY_NONE) continue;
            arriving = unpack_visibility(found);
        }
        vec3 irradiance, open;
        bool soft = is_area_light(light);
        if (soft) {
            AreaLight area = area_light_at(light, surface.position, surface.normal);
            if (area.irradiance <= 0.0) continue;
            irradiance = light.intensity * area.irradiance;
            vec3 h = normalize(normalize(light.position - surface.position) + view);
            open = irradiance * brdf_diffuse(brdf, clamp(dot(view, h), 0.0, 1.0)) +
                   light.intensity * area_light_specular(area, brdf, surface.position, surface.normal, view);
            if (i >= shadows.known) {
                vec2 turn = evenly_spread(shadows.turn, 7 * light.number);
                if (shadows.later != vec3(0.0)) {
                    float weight = 0.0;
                    vec3 target;
                    for (uint k = 0; k < 8 && weight == 0.0; ++k) {  // not one below the horizon
                        target = area_light_point(area, surface.position, surface.normal, evenly_spread(turn, k), weight);
                    }
                    if (weight > 0.0 && shadow_later(surface, target, shadows.later * open)) continue;
                }
                arriving = area_light_visibility(area, surface, turn, shadows.samples);
            }
        } else {
            LightArrival arrival = punctual_light(light, surface.position);
            irradiance = arrival.irradiance * max(dot(surface.normal, arrival.direction), 0.0);
            if (irradiance == vec3(0.0)) continue;
            open = irradiance * brdf_value(brdf, surface.normal, view, arrival.direction);
            if (i >= shadows.known) {
                vec3 target = surface.position + arrival.distance * arrival.direction;
                if (shadows.later != vec3(0.0) && shadow_later(surface, target, shadows.later * open)) continue;
                arriving = light_through(surface, target);
            }
        }
        sum.unshadowed += irradiance;
        sum.irradiance += irradiance * arriving;
        sum.radiance += arriving * open;
        if (!soft) continue;
        sum.soft += arriving * open;
        sum.soft_open += open;
        sum.soft_irradiance += irradiance * arriving;
        sum.soft_unshadowed += irradiance;
    }
    return sum;
}

#endif
