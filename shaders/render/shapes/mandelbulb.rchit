#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/render/shapes/mandelbulb.glsl"
#include "shaders/render/shapes/distance_surface.glsl"

void main() {
    vec3 p = hit_position();
    vec3 z = p;
    float r_2 = dot(z, z), slope = 1.0, trap = r_2;
    for (uint i = 0; i < record.iterations && r_2 < record.far_2; ++i) {
        z = mandelbulb_step(z, r_2, p, slope);
        r_2 = dot(z, z);
        trap = min(trap, r_2);
    }
    vec3 color = mix(vec3(1.0), record.orbit_color, clamp(2.0 * sqrt(trap) - 1.0, 0.0, 1.0));
    fill_distance_surface(distance_gradient(p), color, ESTIMATE_FACTOR);
}
