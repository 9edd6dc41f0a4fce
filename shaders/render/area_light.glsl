// Lights with an area, of the same radiance everywhere: rectangles that shine to one side, boxes, spheres. A box is
// the up to three rectangles of it that a point sees. Everything here is for radiance 1.
#ifndef FOVERAY_RENDER_AREA_LIGHT_GLSL
#define FOVERAY_RENDER_AREA_LIGHT_GLSL

#include "shaders/render/rectangle.glsl"
#include "shaders/render/sphere_light.glsl"
#include "shaders/shared/scene.h"

bool is_area_light(Light light) { return light.type >= LIGHT_RECTANGLE; }

// What a surface receives of a light before anything stands in between.
struct AreaLight {
    Light light;
    Rectangle face[3];  // those that face the surface
    vec3 face_end;      // running sum of the faces' shares of the irradiance: 0 … 1
    float irradiance;   // 0 … π
};

SphereLight sphere_of(Light light) { return SphereLight(light.position, light.range); }

Rectangle box_face(Light light, vec3 position, uint axis) {
    vec3 axes[3] = vec3[3](light.half_u, light.half_v, light.range * light.direction);
    vec3 out_of_face = axes[axis], u = axes[(axis + 1) % 3], v = axes[(axis + 2) % 3];
    if (dot(out_of_face, position - light.position) < 0.0) out_of_face = -out_of_face;
    bool outwards = dot(cross(u, v), out_of_face) > 0.0;
    return Rectangle(light.position + out_of_face, outwards ? u : v, outwards ? v : u);
}

AreaLight area_light_at(Light light, vec3 position, vec3 normal) {
    AreaLight area;
    area.light = light;
    area.face_end = vec3(1.0);
    area.face[0] = Rectangle(light.position, light.half_u, light.half_v);
    if (light.type == LIGHT_SPHERE) {
        area.irradiance = sphere_irradiance(sphere_of(light), position, normal);
    } else if (light.type == LIGHT_RECTANGLE) {
        area.irradiance = rectangle_irradiance(area.face[0], position, normal);
    } else {
        vec3 part;
        for (uint axis = 0; axis < 3; ++axis) {
            area.face[axis] = box_face(light, position, axis);
            part[axis] = rectangle_irradiance(area.face[axis], position, normal);
        }
        area.irradiance = part.x + part.y + part.z;
        area.face_end = vec3(part.x, part.x + part.y, area.irradiance) / max(area.irradiance, 1e-30);
    }
    return area;
}

// Point for uv in [0, 1)² and what it counts for, to a factor: even uv are spread evenly over the light.
vec3 area_light_point(AreaLight area, vec3 position, vec3 normal, vec2 uv, out float weight) {
    if (area.light.type == LIGHT_SPHERE) {
        vec3 point = sphere_point(sphere_of(area.light), position, uv);
        weight = max(dot(normal, normalize(point - position)), 0.0);
        return point;
    }
    if (area.light.type == LIGHT_RECTANGLE) {
        vec3 point = rectangle_point(area.face[0], uv);
        weight = rectangle_weight(area.face[0], point, position, normal);
        return point;
    }
    uint i = uv.x < area.face_end.x ? 0 : uv.x < area.face_end.y ? 1 : 2;
    float start = i == 0 ? 0.0 : area.face_end[i - 1];
    float share = area.face_end[i] - start;
    vec3 point = rectangle_point(area.face[i], vec2((uv.x - start) / share, uv.y));
    weight = rectangle_weight(area.face[i], point, position, normal) / share;
    return point;
}

// Points round the light as seen from `position`. What has a straight edge, and hides a part of a rectangle or a box,
// hides one of them.
uint area_light_outline_count(Light light) {
    return light.type == LIGHT_RECTANGLE ? 4 : light.type == LIGHT_BOX ? 8 : 6;
}

vec3 area_light_outline(Light light, vec3 position, uint i) {
    if (light.type == LIGHT_SPHERE) {
        vec3 way = light.position - position;
        float sine_2 = min(light.range * light.range / dot(way, way), 1.0);
        vec3 u, v;
        across(normalize(way), u, v);
        float angle = 2.0 * PI * float(i) / 6.0;
        return light.position - sine_2 * way + light.range * sqrt(1.0 - sine_2) * (cos(angle) * u + sin(angle) * v);
    }
    vec3 corner = light.position + ((i & 1) == 0 ? -light.half_u : light.half_u) + ((i & 2) == 0 ? -light.half_v : light.half_v);
    if (light.type == LIGHT_RECTANGLE) return corner;
    return corner + ((i & 4) == 0 ? -light.range : light.range) * light.direction;
}

// Whether corner i of a box is on its outline: not where all or none of the three faces round it are seen.
bool on_box_outline(Light light, vec3 position, uint i) {
    vec3 way = position - light.position;
    vec3 axes[3] = vec3[3](light.half_u, light.half_v, light.range * light.direction);
    uint seen = 0;
    for (uint axis = 0; axis < 3; ++axis) {
        float out_of_face = dot((i >> axis & 1) == 0 ? -axes[axis] : axes[axis], way);
        if (out_of_face > dot(axes[axis], axes[axis])) ++seen;
    }
    return seen == 1 || seen == 2;
}

// Mirror part of what the unshadowed light sends to the viewer.
vec3 area_light_specular(AreaLight area, Brdf brdf, vec3 position, vec3 normal, vec3 view) {
    if (area.light.type == LIGHT_SPHERE) return sphere_specular(sphere_of(area.light), brdf, position, normal, view);
    vec3 sum = vec3(0.0);
    uint count = area.light.type == LIGHT_BOX ? 3 : 1;
    for (uint i = 0; i < count; ++i) sum += rectangle_specular(area.face[i], brdf, position, normal, view);
    return sum;
}

#endif
