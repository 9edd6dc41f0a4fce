#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/render/shapes/surface.glsl"

layout(shaderRecordEXT, scalar) buffer RecordBlock { PlaneRecord record; };

// How much of a box of `width` round `at` has the pattern's second colour; both count in cells. From the integral of a
// square wave in each direction (Quilez, "Box-filtering procedural patterns").
float checker(vec2 at, vec2 width) {
    vec2 before = abs(fract((at - 0.5 * width) * 0.5) - 0.5), after = abs(fract((at + 0.5 * width) * 0.5) - 0.5);
    vec2 wave = 2.0 * (before - after) / width;
    return 0.5 - 0.5 * wave.x * wave.y;
}

// Width along x and z of the ellipse that the ray's cone cuts out of the plane, object space.
vec2 cone_on_plane(vec3 normal) {
    vec3 direction = gl_WorldRayDirectionEXT;
    vec3 flat_part = direction - dot(direction, normal) * normal;
    float slant = length(flat_part);
    vec3 away = slant > 1e-6 ? flat_part / slant : vec3(0.0);
    float facing = max(abs(dot(direction, normal)), 1e-4);
    mat3 object_from_world = mat3(gl_WorldToObjectEXT);
    vec3 lengthwise = object_from_world * (away / facing);
    vec3 across = object_from_world * (slant > 1e-6 ? cross(away, normal) : vec3(1.0, 0.0, 0.0));
    return hit_footprint() * sqrt(lengthwise.xz * lengthwise.xz + across.xz * across.xz);
}

void main() {
    fill_surface(record.shape, vec3(0.0, 1.0, 0.0), record.shape.material, vec4(1.0), 0.0);
    // Nothing is within a plane, unless it is the skin of something.
    if ((record.shape.flags & SHAPE_SINGLE_SIDED) == 0) surface.flags &= ~SURFACE_FLAG_INSIDE;
    if (record.checker_size <= 0.0) return;
    // Narrower than this the difference of the integrals drowns in rounding.
    vec2 width = max(cone_on_plane(surface.geometric_normal) / record.checker_size, 2e-3);
    float second = checker(hit_position().xz / record.checker_size, width);
    surface.base_color = mix(surface.base_color, record.checker_color, second);
}
