// How much of a light reaches a surface. The including shader has `push` with `flags`.
#ifndef FOVERAY_RENDER_LIGHT_VISIBILITY_GLSL
#define FOVERAY_RENDER_LIGHT_VISIBILITY_GLSL

#include "shaders/render/area_light.glsl"
#include "shaders/render/log_rays.glsl"
#include "shaders/render/low_discrepancy.glsl"
#include "shaders/render/punctual_light.glsl"
#include "shaders/render/surface_sides.glsl"
#include "shaders/render/trace_shadow.glsl"
#include "shaders/render/vectors.glsl"
#include "shaders/shared/lighting.h"
#include "shaders/shared/surface.h"

uint shadow_ray_count = 0;

RayCone shadow_cone(Surface surface) {
    return RayCone(surface.footprint, surface.footprint / max(surface.distance, 1e-3));
}

// What virtual things let through from a point to another.
vec3 light_between(vec3 origin, vec3 target, RayCone cone) {
    vec3 way = target - origin;
    float length_of_way = length(way);
    ++shadow_ray_count;
    log_ray(SHADOW_RAY_FLAGS, MASK_VIRTUAL, origin, way / length_of_way, length_of_way * 0.9999, cone);
    return trace_shadow(MASK_VIRTUAL, origin, way / length_of_way, length_of_way * 0.9999, cone);
}

// Nothing when the target lies below the surface.
vec3 light_through(Surface surface, vec3 target) {
    if ((push.flags & LIGHTING_SHADOWS) == 0) return vec3(1.0);
    if (dot(surface.geometric_normal, target - surface.position) <= 0.0) return vec3(0.0);
    return light_between(above_surface(surface), target, shadow_cone(surface));
}

// Part of an area light's irradiance that arrives, from samples spread evenly over the light.
vec3 area_light_visibility(AreaLight area, Surface surface, vec2 turn, uint samples) {
    vec3 arrived = vec3(0.0);
    float sent = 0.0;
    // Where all that were asked for lie below the horizon, some more: the light does shine here.
    for (uint i = 0; i < samples || (sent == 0.0 && i < samples + 8); ++i) {
        float weight;
        vec3 target = area_light_point(area, surface.position, surface.normal, net_point(i, samples, turn), weight);
        if (weight == 0.0) continue;
        sent += weight;
        arrived += weight * light_through(surface, target);
    }
    return sent > 0.0 ? arrived / sent : vec3(1.0);
}

const uint FIRST_SAMPLES = 2;

// What all of a few samples and the light's outline agree on; `mixed` where they do not. What has a straight edge and
// hides a part of the light cannot escape that, and what is smaller is met by the samples of neighbours.
vec3 agreed_visibility(AreaLight area, Surface surface, vec2 turn, bool thorough, out bool mixed) {
    uint outline = thorough ? area_light_outline_count(area.light) : 0;
    vec3 first = vec3(-1.0);
    mixed = false;
    for (uint i = 0; i < outline + FIRST_SAMPLES; ++i) {
        if (i < outline && area.light.type == LIGHT_BOX && !on_box_outline(area.light, surface.position, i)) continue;
        float weight;
        vec3 target = i < outline ? area_light_outline(area.light, surface.position, i)
                                  : area_light_point(area, surface.position, surface.normal,
                                                     evenly_spread(turn, i - outline), weight);
        vec3 through = light_through(surface, target);
        if (first.x < 0.0) first = through;
        if (through != first) {
            mixed = true;
            break;
        }
    }
    return first;
}

// What arrives of a light, in parts; x < 0: it does not shine there. `mixed`: all samples must be taken.
// `thorough`: one of each four neighbours at least should be.
vec3 first_visibility(Light light, Surface surface, vec2 turn, uint samples, bool thorough, out bool mixed) {
    mixed = false;
    if (!is_area_light(light)) {
        LightArrival arrival = punctual_light(light, surface.position);
        bool reaches = greatest(arrival.irradiance) > 0.0 && dot(surface.normal, arrival.direction) > 0.0;
        if (!reaches) return vec3(-1.0);
        return light_through(surface, surface.position + arrival.distance * arrival.direction);
    }
    AreaLight area = area_light_at(light, surface.position, surface.normal);
    if (area.irradiance <= 0.0) return vec3(-1.0);
    bool adaptive = (push.flags & LIGHTING_ADAPTIVE_SHADOWS) != 0;
    return adaptive ? agreed_visibility(area, surface, turn, thorough, mixed) : area_light_visibility(area, surface, turn, samples);
}

#endif
