// What closest-hit shaders of distance shapes share. The including shader has `record` as in intersect.glsl.
#ifndef FOVERAY_RENDER_SHAPES_DISTANCE_SURFACE_GLSL
#define FOVERAY_RENDER_SHAPES_DISTANCE_SURFACE_GLSL

#include "shaders/render/shapes/surface.glsl"

float shape_distance(vec3 p);

// How near to the surface counted as hit, object units.
float hit_threshold() { return hit.error * length(gl_ObjectRayDirectionEXT); }

// Gradient of the distance by differences over a tetrahedron (Quilez, "Normals for an SDF"), as wide as the ray could
// tell. A loop, so that the compiler puts one copy of the distance into the shader.
vec3 distance_gradient(vec3 p) {
    float h = max(hit_threshold(), 1e-5 * length(p));
    vec3 sum = vec3(0.0);
    for (uint i = 0; i < 4; ++i) {
        vec3 corner = 2.0 * vec3((i + 3) >> 1 & 1, i >> 1 & 1, i & 1) - 1.0;
        sum += corner * shape_distance(p + 0.57735 * h * corner);
    }
    return dot(sum, sum) > 0.0 ? sum : -gl_ObjectRayDirectionEXT;
}

// A fractal's surface is mostly about twice as far as its distance estimate says.
const float ESTIMATE_FACTOR = 2.0;

// `outward`: object space, any length. `color` multiplies the material's. `factor`: how much farther than its distance the
// surface may be.
void fill_distance_surface(vec3 outward, vec3 color, float factor) {
    vec3 normal = normalize(outward);
    // A step along the world's normal is this much shorter or longer seen from the surface in object space.
    float object_length = length(normal * mat3(gl_WorldToObjectEXT));
    fill_surface(record.shape, normal, record.shape.material, vec4(color, 1.0), factor * hit_threshold() / object_length);
}

#endif
