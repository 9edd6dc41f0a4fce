// A sphere of light of radiance 1.
#ifndef FOVERAY_RENDER_SPHERE_LIGHT_GLSL
#define FOVERAY_RENDER_SPHERE_LIGHT_GLSL

#include "shaders/render/brdf.glsl"

struct SphereLight {
    vec3 center;
    float radius;
};

// Irradiance at an unshadowed point outside, 0 … π, with the sphere cut off at the surface's horizon: Lagarde and
// de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section 4.7.2.
float sphere_irradiance(SphereLight s, vec3 position, vec3 normal) {
    vec3 way = s.center - position;
    float distance_2 = dot(way, way);
    float sine_2 = s.radius * s.radius / distance_2;  // of the sphere's angular radius
    if (sine_2 >= 1.0) return PI;                     // inside: light from everywhere
    float cosine = clamp(dot(normal, way) * inversesqrt(distance_2), -0.9999, 0.9999);
    if (cosine * cosine > sine_2) return PI * sine_2 * max(cosine, 0.0);
    float sine = sqrt(1.0 - cosine * cosine);
    float x = sqrt(1.0 / sine_2 - 1.0);
    float y = -x * cosine / sine;
    float z = sine * sqrt(max(1.0 - y * y, 0.0));
    return max((cosine * acos(clamp(y, -1.0, 1.0)) - x * z) * sine_2 + atan(z / x), 0.0);
}

// Unit vectors across `axis` and one another.
void across(vec3 axis, out vec3 u, out vec3 v) {
    u = normalize(abs(axis.y) < 0.9 ? cross(axis, vec3(0, 1, 0)) : cross(axis, vec3(1, 0, 0)));
    v = cross(axis, u);
}

// Place in the unit disc: neighbours in the square stay neighbours. Shirley and Chiu 1997, "A Low
// Distortion Map Between Disk and Square".
vec2 disc_point(vec2 uv) {
    vec2 p = 2.0 * uv - 1.0;
    if (p == vec2(0.0)) return vec2(0.0);
    bool wide = abs(p.x) > abs(p.y);
    float radius = wide ? p.x : p.y;
    float angle = wide ? PI / 4.0 * (p.y / p.x) : PI / 2.0 - PI / 4.0 * (p.x / p.y);
    return radius * vec2(cos(angle), sin(angle));
}

// Point on the side that faces `position`, uniform in solid angle.
vec3 sphere_point(SphereLight s, vec3 position, vec2 uv) {
    vec2 disc = disc_point(uv);
    vec3 way = s.center - position;
    float distance_to_center = length(way);
    vec3 axis = way / distance_to_center;
    float sine_2_max = min(s.radius * s.radius / (distance_to_center * distance_to_center), 1.0);
    float cosine = 1.0 - dot(disc, disc) * (1.0 - sqrt(1.0 - sine_2_max));
    float sine_2 = max(1.0 - cosine * cosine, 0.0);
    float reach = distance_to_center * cosine -
                  sqrt(max(s.radius * s.radius - distance_to_center * distance_to_center * sine_2, 0.0));
    vec3 u, v;
    across(axis, u, v);
    vec2 towards = disc * inversesqrt(max(dot(disc, disc), 1e-12));
    return position + reach * (cosine * axis + sqrt(sine_2) * (towards.x * u + towards.y * v));
}

// As rectangle_specular: Karis 2013, eq. 10-12.
vec3 sphere_specular(SphereLight s, Brdf brdf, vec3 position, vec3 normal, vec3 view) {
    vec3 center = s.center - position;
    vec3 mirrored = reflect(-view, normal);
    vec3 center_to_ray = max(dot(center, mirrored), 0.0) * mirrored - center;
    vec3 point = center + center_to_ray * min(s.radius * inversesqrt(max(dot(center_to_ray, center_to_ray), 1e-12)), 1.0);
    vec3 l = normalize(point);
    float n_dot_l = dot(normal, l);
    if (n_dot_l <= 0.0) return vec3(0.0);
    float sine_2 = min(s.radius * s.radius / dot(center, center), 1.0);
    return brdf_specular_widened(brdf, normal, view, l, 0.5 * sqrt(sine_2)) * n_dot_l * PI * sine_2;
}

#endif
