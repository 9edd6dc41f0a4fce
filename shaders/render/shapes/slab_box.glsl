// Boxes: the including shader has declared its record and included intersect.glsl.
#ifndef FOVERAY_RENDER_SHAPES_SLAB_BOX_GLSL
#define FOVERAY_RENDER_SHAPES_SLAB_BOX_GLSL

#include "shaders/render/shapes/convex.glsl"

// Reports the box in a space turned from the object's by `object_from_box`.
void report_box(vec3 half_size, vec3 origin, vec3 direction, mat3 object_from_box) {
    vec3 entries, exits;
    slab_distances(half_size, origin, direction, entries, exits);
    float entry = largest(entries), exit = smallest(exits);
    if (!(entry < exit)) return;
    vec3 along = mix(vec3(1.0), vec3(-1.0), lessThan(direction, vec3(0.0)));
    vec3 normal = -along * vec3(equal(entries, vec3(entry)));
    if (report_surface(entry, object_from_box * normal, false, 0.0, 0)) return;
    normal = along * vec3(equal(exits, vec3(exit)));
    report_surface(exit, object_from_box * normal, true, 0.0, 0);
}

#endif
