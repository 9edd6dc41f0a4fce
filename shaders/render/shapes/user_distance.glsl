// Intersection shader of a user's shape that defines distance_at(). The program writes shape_distance, which calls it with
// the record's values.
#include "shaders/render/shapes/user_record.glsl"
#include "shaders/render/shapes/sphere_trace.glsl"

void main() {
    vec3 center = 0.5 * (record.bounds_min + record.bounds_max);
    vec3 half_size = 0.5 * (record.bounds_max - record.bounds_min);
    sphere_trace(box_span(half_size, gl_ObjectRayOriginEXT - center, gl_ObjectRayDirectionEXT));
}
