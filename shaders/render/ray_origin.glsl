// Wächter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection" (Ray Tracing Gems, chapter 6):
// moves a point off its surface by what its floating-point error may be, after `error` for what else it may be off.
#ifndef FOVERAY_RENDER_RAY_ORIGIN_GLSL
#define FOVERAY_RENDER_RAY_ORIGIN_GLSL

// `normal` is geometric and points to the side that the ray leaves to.
vec3 ray_origin(vec3 surface_position, float error, vec3 normal) {
    vec3 position = surface_position + error * normal;
    const float near_zero = 1.0 / 32.0;
    const float float_scale = 1.0 / 65536.0;
    const float int_scale = 256.0;
    ivec3 step_bits = ivec3(int_scale * normal);
    vec3 stepped = intBitsToFloat(floatBitsToInt(position) +
                                  ivec3(position.x < 0 ? -step_bits.x : step_bits.x,
                                        position.y < 0 ? -step_bits.y : step_bits.y,
                                        position.z < 0 ? -step_bits.z : step_bits.z));
    vec3 small = position + float_scale * normal;
    return mix(stepped, small, lessThan(abs(position), vec3(near_zero)));
}

#endif
