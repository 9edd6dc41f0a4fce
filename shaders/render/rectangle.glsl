// A rectangle of light of radiance 1 on one side.
#ifndef FOVERAY_RENDER_RECTANGLE_GLSL
#define FOVERAY_RENDER_RECTANGLE_GLSL

#include "shaders/render/brdf.glsl"

// Shines to the side that cross(half_u, half_v) points to.
struct Rectangle {
    vec3 center;
    vec3 half_u;
    vec3 half_v;
};

vec3 rectangle_point(Rectangle r, vec2 uv) {
    return r.center + (2.0 * uv.x - 1.0) * r.half_u + (2.0 * uv.y - 1.0) * r.half_v;
}

bool rectangle_faces(Rectangle r, vec3 position) {
    return dot(cross(r.half_u, r.half_v), position - r.center) > 0.0;
}

// Irradiance at an unshadowed point, 0 … π: Lambert's formula for polygons (Baum, Rushmeier and Winget 1989, eq. 6),
// with the rectangle cut off at the surface's horizon.
float rectangle_irradiance(Rectangle r, vec3 position, vec3 normal) {
    if (!rectangle_faces(r, position)) return 0.0;
    const vec2 corners[4] = vec2[4](vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1));
    vec3 polygon[5];
    uint count = 0;
    for (uint i = 0; i < 4; ++i) {
        vec3 a = rectangle_point(r, corners[i]) - position;
        vec3 b = rectangle_point(r, corners[(i + 1) % 4]) - position;
        float height_a = dot(normal, a), height_b = dot(normal, b);
        if (height_a >= 0.0) polygon[count++] = a;
        if (height_a * height_b < 0.0) polygon[count++] = a + (b - a) * (height_a / (height_a - height_b));
    }
    float sum = 0.0;
    for (uint i = 0; i < count; ++i) {
        vec3 a = normalize(polygon[i]), b = normalize(polygon[(i + 1) % count]);
        vec3 axis = cross(b, a);  // the rectangle is seen from its front: its corners go clockwise
        float sine = length(axis);
        if (sine > 0.0) sum += atan(sine, dot(a, b)) * dot(axis, normal) / sine;
    }
    return max(0.5 * sum, 0.0);
}

// What a small piece of the rectangle at `target` counts for, to a factor: its irradiance.
float rectangle_weight(Rectangle r, vec3 target, vec3 position, vec3 normal) {
    vec3 way = target - position;
    float distance_2 = dot(way, way);
    return max(dot(normal, way), 0.0) * max(-dot(cross(r.half_u, r.half_v), way), 0.0) / (distance_2 * distance_2);
}

// Mirror part of what the unshadowed rectangle sends to the viewer: the point nearest to the mirrored ray stands for
// the whole. Karis 2013, "Real Shading in Unreal Engine 4", eq. 10-14; a disc of the same area gives the
// normalisation.
vec3 rectangle_specular(Rectangle r, Brdf brdf, vec3 position, vec3 normal, vec3 view) {
    vec3 light_normal = cross(r.half_u, r.half_v);
    vec3 mirrored = reflect(-view, normal);
    vec3 center = r.center - position;
    float towards = dot(mirrored, light_normal);
    // A mirrored ray that leaves the light behind is followed as far as the light's centre.
    vec3 target = towards < 0.0 ? mirrored * (dot(center, light_normal) / towards) : mirrored * length(center);
    vec3 from_center = target - center;
    vec2 uv = vec2(dot(from_center, r.half_u) / dot(r.half_u, r.half_u),
                   dot(from_center, r.half_v) / dot(r.half_v, r.half_v));
    uv = clamp(uv, vec2(-1.0), vec2(1.0));
    vec3 point = center + uv.x * r.half_u + uv.y * r.half_v;
    float distance_2 = dot(point, point);
    vec3 l = point * inversesqrt(distance_2);
    float n_dot_l = dot(normal, l);
    float area = 4.0 * length(light_normal);
    float cos_light = -dot(l, light_normal) * 4.0 / area;
    if (n_dot_l <= 0.0 || cos_light <= 0.0) return vec3(0.0);
    float solid_angle = cos_light * area / distance_2;
    return brdf_specular_widened(brdf, normal, view, l, 0.5 * sqrt(solid_angle / PI)) * n_dot_l * solid_angle;
}

#endif
