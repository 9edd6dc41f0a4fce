// picture.debug_view=probes: every probe as a sphere that shows what a white matte ball would reflect there. Sleeping ones
// are striped blue, those within geometry red.
#ifndef FOVERAY_RENDER_PROBE_SPHERES_GLSL
#define FOVERAY_RENDER_PROBE_SPHERES_GLSL

#include "shaders/render/brdf.glsl"
#include "shaders/render/probe_field.glsl"
#include "shaders/shared/light_layers.h"

const float SPHERE_RADIUS = 0.08;  // of the spacing

vec3 probe_sphere_color(ProbeField field, uint probe, uint flags, vec3 normal) {
    if ((flags & PROBE_INSIDE) != 0) return vec3(0.8, 0.02, 0.02);
    vec3 color = probe_light(field, probe, probe_texels(normal, PROBE_LIGHT_SIDE)) / PI;
    bool striped = (flags & PROBE_ASLEEP) != 0 && fract(3.0 * normal.y) < 0.5;
    return striped ? vec3(0.02, 0.05, 0.8) : color;
}

// In front of what the sample shows.
void draw_probes(uint64_t probes, vec3 origin, vec3 direction, inout LightSample light) {
    if (probes == 0) return;
    ProbeField field = ProbeFieldArray(probes).at[0];
    float radius = SPHERE_RADIUS * min(field.spacing.x, min(field.spacing.y, field.spacing.z));
    float nearest = light.distance < 0.0 ? 1e6 : light.distance;
    uint count = field.count_x * field.count_y * field.count_z;
    for (uint probe = 0; probe < count; ++probe) {
        ProbeState state = ProbeStateArray(field.states).at[probe];
        vec3 center = probe_rest_position(field, probe) + state.offset - origin;
        float along = dot(center, direction);
        vec3 aside = center - along * direction;
        float inside = radius * radius - dot(aside, aside);
        if (inside <= 0.0 || along <= 0.0) continue;
        float t = along - sqrt(inside);
        if (t <= 0.0 || t >= nearest) continue;
        nearest = t;
        vec3 normal = (t * direction - center) / radius;
        light = LightSample(probe_sphere_color(field, probe, state.flags, normal), 1.0, vec3(1.0), t, vec3(0.0), 1.0);
    }
}

#endif
