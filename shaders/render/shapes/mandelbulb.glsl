// The Mandelbulb (White and Nylander 2009): the points c that `iterations` of z -> z^power + c, from z = c, leave within
// the escape radius. z^n multiplies both of z's polar angles, round the y axis, by n.
#ifndef FOVERAY_RENDER_SHAPES_MANDELBULB_GLSL
#define FOVERAY_RENDER_SHAPES_MANDELBULB_GLSL

#include "shaders/shared/shapes.h"

layout(shaderRecordEXT, scalar) buffer RecordBlock { MandelbulbRecord record; };

const float MANDELBULB_INSIDE = 0.1;  // longest step inside, where no bound is known

vec2 complex_square(vec2 a) { return vec2(a.x * a.x - a.y * a.y, 2.0 * a.x * a.y); }

// Without angles: three squarings of the complex numbers that they belong to. (y, rho)^2 is (u, v rho) with polynomials u
// and v, so that rho, the distance from the axis, is drawn but once.
vec3 eighth_power(vec3 z) {
    float rho_2 = max(dot(z.xz, z.xz), 1e-20);
    float inverse_rho = inversesqrt(rho_2);
    vec2 round_axis = complex_square(complex_square(complex_square(z.zx * inverse_rho)));
    float u = z.y * z.y - rho_2, v = 2.0 * z.y;
    for (uint i = 0; i < 2; ++i) {
        float uv = 2.0 * u * v;
        u = u * u - v * v * rho_2;
        v = uv;
    }
    float away = v * rho_2 * inverse_rho;
    return vec3(away * round_axis.y, u, away * round_axis.x);
}

vec3 any_power(vec3 z, float r_2) {
    float r = sqrt(r_2);
    float polar = record.power * acos(clamp(z.y / max(r, 1e-20), -1.0, 1.0));
    float azimuth = dot(z.xz, z.xz) > 0.0 ? record.power * atan(z.x, z.z) : 0.0;
    float length_ = pow(r, record.power);
    return length_ * vec3(sin(polar) * sin(azimuth), cos(polar), sin(polar) * cos(azimuth));
}

// z^power + c, where r_2 = |z|^2; slope becomes that of the new z.
vec3 mandelbulb_step(vec3 z, float r_2, vec3 c, inout float slope) {
    if (record.power == 8.0) {
        slope = 8.0 * r_2 * r_2 * r_2 * sqrt(r_2) * slope + 1.0;
        return eighth_power(z) + c;
    }
    slope = record.power * pow(r_2, 0.5 * record.power - 0.5) * slope + 1.0;
    return any_power(z, r_2) + c;
}

// As for Julia sets: half of the potential over its gradient.
float shape_distance(vec3 p) {
    vec3 z = p;
    float r_2 = dot(z, z), slope = 1.0;
    uint left = record.iterations;
    while (left > 0 && r_2 < record.far_2) {
        z = mandelbulb_step(z, r_2, p, slope);
        r_2 = dot(z, z);
        --left;
    }
    if (r_2 < record.radius * record.radius) {
        return -min(0.25 * (record.radius - sqrt(r_2)) / slope, MANDELBULB_INSIDE);
    }
    float level = 2.0 * log(record.radius) * exp2(-float(left) * log2(record.power));
    return 0.25 * sqrt(r_2) * (log(r_2) - level) / slope;
}

#endif
