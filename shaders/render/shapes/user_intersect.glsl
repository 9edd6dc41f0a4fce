// Intersection shader of a user's shape that defines intersect(). The program writes shape_intersect, which calls it with
// the record's values.
#include "shaders/render/shapes/user_record.glsl"
#include "shaders/render/shapes/intersect.glsl"

bool shape_intersect(vec3 origin, vec3 direction, float t_min, float t_max, out float t, out vec3 normal);

// The user's ray has a direction of unit length. A surface that this ray does not see lies in front of those that it may.
void main() {
    const int most_surfaces = 8;
    float speed = length(gl_ObjectRayDirectionEXT);
    vec3 direction = gl_ObjectRayDirectionEXT / speed;
    float t_min = gl_RayTminEXT * speed, t_max = gl_RayTmaxEXT * speed;
    for (int i = 0; i < most_surfaces; ++i) {
        float t;
        vec3 normal;
        if (!shape_intersect(gl_ObjectRayOriginEXT, direction, t_min, t_max, t, normal)) return;
        if (!(t >= t_min && t <= t_max)) return;
        if (report_surface(t / speed, normal, dot(normal, direction) > 0.0, 0.0, 0)) return;
        t_min = t + 1e-5 * max(t, distance(record.bounds_min, record.bounds_max));
    }
}
