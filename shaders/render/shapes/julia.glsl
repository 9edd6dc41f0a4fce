// Quaternion Julia sets (Hart, Sandin, Kauffman 1989, "Ray Tracing Deterministic 3-D Fractals"): the points
// q = x + y i + z j that `iterations` of q -> q^2 + c leave within the escape radius.
#ifndef FOVERAY_RENDER_SHAPES_JULIA_GLSL
#define FOVERAY_RENDER_SHAPES_JULIA_GLSL

#include "shaders/shared/shapes.h"

layout(shaderRecordEXT, scalar) buffer RecordBlock { JuliaRecord record; };

const float JULIA_FAR_2 = 1e4;     // square of the distance from which the potential is the logarithm
const float JULIA_INSIDE = 0.1;    // longest step inside, where no bound is known

const uint JULIA_SURFACE = 0u;  // ShapeHit.detail
const uint JULIA_CUT = 1u;

// q^2 + c, where q_2 = |q|^2.
vec4 julia_step(vec4 q, float q_2) { return vec4(2.0 * q.x * q.x - q_2, 2.0 * q.x * q.yzw) + record.c; }

// Half of the potential over its gradient, a bound by Koebe's theorem. Both take their level from the escape radius after
// the last iteration, so that the distance is 0 where the set, as far as it is iterated, begins.
float shape_distance(vec3 p) {
    vec4 q = vec4(p, 0.0);
    float q_2 = dot(q, q), slope_2 = 1.0;
    int left = int(record.iterations);
    while (left > 0 && q_2 < JULIA_FAR_2) {
        slope_2 *= 4.0 * q_2;
        q = julia_step(q, q_2);
        q_2 = dot(q, q);
        --left;
    }
    float over_slope = 0.25 * inversesqrt(max(slope_2, 1e-30));
    if (q_2 < record.radius * record.radius) return -min(over_slope * (record.radius - sqrt(q_2)), JULIA_INSIDE);
    return over_slope * sqrt(q_2) * (log(q_2) - 2.0 * log(record.radius) * exp2(-float(left)));
}

#endif
