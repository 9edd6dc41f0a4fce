// Closest-hit shader of a user's shape that defines intersect(). The program writes shape_color, which calls the user's
// color_at if there is one.
#include "shaders/render/shapes/surface.glsl"
#include "shaders/render/shapes/user_record.glsl"

vec4 shape_color(vec3 p, vec3 normal);

void main() {
    vec3 normal = normalize(hit.normal);
    fill_surface(record.shape, normal, record.shape.material, shape_color(hit_position(), normal), hit.error);
}
