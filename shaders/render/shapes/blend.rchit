#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/render/shapes/blend.glsl"
#include "shaders/render/shapes/distance_surface.glsl"

// The parts' colours, each by what it adds to the surface here.
vec3 blended_color(vec3 p) {
    BlendPartArray parts = BlendPartArray(record.parts);
    float distance = part_distance(parts.at[0], p);
    vec3 color = parts.at[0].color;
    for (uint i = 1; i < record.part_count; ++i) {
        BlendPart part = parts.at[i];
        float part_away = part_distance(part, p);
        float a = part.operation == BLEND_UNION ? distance : -distance;
        float b = part.operation == BLEND_INTERSECT ? -part_away : part_away;
        float h = nearness(a, b);
        float share = 0.5 * h * h;  // of the one that counts less
        color = mix(color, part.color, a < b ? share : 1.0 - share);
        distance = join(distance, part_away, part.operation);
    }
    return color;
}

void main() {
    vec3 p = hit_position();
    fill_distance_surface(distance_gradient(p), blended_color(p), 1.0);
}
