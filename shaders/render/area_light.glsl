// Rectangles that shine to one side with the same radiance everywhere.
#ifndef FOVERAY_RENDER_AREA_LIGHT_GLSL
#define FOVERAY_RENDER_AREA_LIGHT_GLSL

#include "shaders/render/brdf.glsl"
#include "shaders/shared/scene.h"

vec3 area_light_point(Light light, vec2 uv) {
    return light.position + (2.0 * uv.x - 1.0) * light.half_u + (2.0 * uv.y - 1.0) * light.half_v;
}

// Irradiance that a rectangle of radiance 1 gives an unshadowed point, 0 … π: Lambert's formula for polygons
// (Baum, Rushmeier and Winget 1989, eq. 6), with the rectangle cut off at the surface's horizon.
float area_light_irradiance(Light light, vec3 position, vec3 normal) {
    if (dot(cross(light.half_u, light.half_v), position - light.position) <= 0.0) return 0.0;
    const vec2 corners[4] = vec2[4](vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1));
    vec3 polygon[5];
    uint count = 0;
    for (uint i = 0; i < 4; ++i) {
        vec3 a = area_light_point(light, corners[i]) - position;
        vec3 b = area_light_point(light, corners[(i + 1) % 4]) - position;
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

// Mirror part of what an unshadowed rectangle of radiance 1 sends to the viewer: the point nearest to the mirrored
// ray stands for the whole. Karis 2013, "Real Shading in Unreal Engine 4", eq. 10-14; a disc of the same area gives the
// normalisation.
vec3 area_light_specular(Light light, Brdf brdf, vec3 position, vec3 normal, vec3 view) {
    vec3 light_normal = cross(light.half_u, light.half_v);
    vec3 r = reflect(-view, normal);
    vec3 center = light.position - position;
    float towards = dot(r, light_normal);
    vec3 target = center;
    if (towards < 0.0) {
        target = r * (dot(center, light_normal) / towards);
    } else {
        target = r * length(center);  // the mirrored ray leaves the light behind
    }
    vec3 from_center = target - center;
    vec2 uv = vec2(dot(from_center, light.half_u) / dot(light.half_u, light.half_u),
                   dot(from_center, light.half_v) / dot(light.half_v, light.half_v));
    uv = clamp(uv, vec2(-1.0), vec2(1.0));
    vec3 point = center + uv.x * light.half_u + uv.y * light.half_v;
    float distance_2 = dot(point, point);
    vec3 l = point * inversesqrt(distance_2);
    float n_dot_l = dot(normal, l);
    float area = 4.0 * length(light_normal);
    float cos_light = -dot(l, light_normal) * 4.0 / area;
    if (n_dot_l <= 0.0 || cos_light <= 0.0) return vec3(0.0);
    vec3 h = normalize(l + view);
    float n_dot_v = clamp(dot(normal, view), 1e-4, 1.0);
    float widened = min(brdf.alpha + 0.5 * sqrt(area * cos_light / (PI * distance_2)), 1.0);
    float ratio = brdf.alpha / widened;
    vec3 value = brdf_specular(brdf, n_dot_l, n_dot_v, clamp(dot(normal, h), 0.0, 1.0), clamp(dot(view, h), 0.0, 1.0));
    return value * (ratio * ratio * n_dot_l * cos_light * area / distance_2);
}

#endif
