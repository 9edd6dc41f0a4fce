// Closest-hit shader of a user's shape that defines distance_at(). The program writes shape_distance, and shape_color, which
// calls the user's color_at if there is one.
#include "shaders/render/shapes/user_record.glsl"
#include "shaders/render/shapes/distance_surface.glsl"

vec4 shape_color(vec3 p, vec3 normal);

void main() {
    vec3 p = hit_position();
    vec3 normal = normalize(distance_gradient(p));
    float object_length = length(normal * mat3(gl_WorldToObjectEXT));
    fill_surface(record.shape, normal, record.shape.material, shape_color(p, normal), hit_threshold() / object_length);
}
