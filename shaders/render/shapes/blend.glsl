// Simple solids joined smoothly, by Quilez' quadratic smooth minimum. All of them, and what is made of them, change by at
// most 1 a unit of length.
#ifndef FOVERAY_RENDER_SHAPES_BLEND_GLSL
#define FOVERAY_RENDER_SHAPES_BLEND_GLSL

#include "shaders/shared/shapes.h"

layout(shaderRecordEXT, scalar) buffer RecordBlock { BlendRecord record; };

float part_distance(BlendPart part, vec3 p) {
    p = part.part_from_object * vec4(p, 1.0);
    if (part.kind == BLEND_BOX) {
        vec3 beyond = abs(p) - part.size;
        return length(max(beyond, vec3(0.0))) + min(max(beyond.x, max(beyond.y, beyond.z)), 0.0);
    }
    if (part.kind == BLEND_TORUS) return length(vec2(length(p.xz) - part.size.x, p.y)) - part.size.y;
    if (part.kind == BLEND_CAPSULE) p.y -= clamp(p.y, -part.size.y, part.size.y);
    return length(p) - part.size.x;
}

// 1 where both count alike, 0 where only the smaller counts.
float nearness(float a, float b) { return max(record.smoothness - abs(a - b), 0.0) / max(record.smoothness, 1e-12); }

float smooth_min(float a, float b) {
    float h = nearness(a, b);
    return min(a, b) - 0.25 * record.smoothness * h * h;
}

float join(float before, float part, uint operation) {
    if (operation == BLEND_UNION) return smooth_min(before, part);
    return -smooth_min(-before, operation == BLEND_SUBTRACT ? part : -part);
}

float shape_distance(vec3 p) {
    BlendPartArray parts = BlendPartArray(record.parts);
    float distance = part_distance(parts.at[0], p);
    for (uint i = 1; i < record.part_count; ++i) {
        BlendPart part = parts.at[i];
        distance = join(distance, part_distance(part, p), part.operation);
    }
    return distance;
}

#endif
