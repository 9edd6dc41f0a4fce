#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/render/shapes/julia.glsl"
#include "shaders/render/shapes/distance_surface.glsl"

// The differential of q^2 at q, along `way`.
vec4 square_slope(vec4 q, vec4 way) {
    return 2.0 * vec4(q.x * way.x - dot(q.yzw, way.yzw), q.x * way.yzw + way.x * q.yzw);
}

// Gradient of |q_n|^2, in the direction of the potential's, and what the orbit came near to.
vec3 julia_gradient(vec3 p, out vec2 trap) {
    vec4 q = vec4(p, 0.0), along_x = vec4(1, 0, 0, 0), along_y = vec4(0, 1, 0, 0), along_z = vec4(0, 0, 1, 0);
    float q_2 = dot(q, q);
    trap = vec2(q_2, abs(q.w));
    for (uint i = 0; i < record.iterations && q_2 < JULIA_FAR_2; ++i) {
        along_x = square_slope(q, along_x);
        along_y = square_slope(q, along_y);
        along_z = square_slope(q, along_z);
        q = julia_step(q, q_2);
        q_2 = dot(q, q);
        trap = min(trap, vec2(q_2, dot(q.yz, q.yz)));
    }
    return vec3(dot(q, along_x), dot(q, along_y), dot(q, along_z));
}

void main() {
    vec2 trap;
    vec3 gradient = julia_gradient(hit_position(), trap);
    if (hit.detail == JULIA_CUT || dot(gradient, gradient) == 0.0) gradient = record.cut.xyz;
    vec3 color = mix(vec3(1.0), record.orbit_color, clamp(sqrt(trap.x), 0.0, 1.0));
    fill_distance_surface(gradient, color, ESTIMATE_FACTOR);
}
