// What closest-hit shaders of shapes share: from hit to Surface.
#ifndef FOVERAY_RENDER_SHAPES_SURFACE_GLSL
#define FOVERAY_RENDER_SHAPES_SURFACE_GLSL

#include "shaders/render/shapes/shape_hit.glsl"
#include "shaders/shared/ray_cone.h"
#include "shaders/shared/scene.h"
#include "shaders/shared/surface.h"

hitAttributeEXT ShapeHit hit;
layout(location = 0) rayPayloadInEXT Surface surface;

vec3 hit_position() { return gl_ObjectRayOriginEXT + gl_HitTEXT * gl_ObjectRayDirectionEXT; }

// Width of the ray's cone at the hit, metres.
float hit_footprint() { return ray_cone_width(ray_cone_of(gl_RayTminEXT), gl_HitTEXT); }

// `outward`: object space, any length.
void fill_surface(ShapeHeader shape, vec3 outward, uint material_id, vec4 color, float error) {
    Material material = MaterialArray(shape.materials).at[material_id];
    InstanceData instance = InstanceArray(shape.instances).at[gl_InstanceCustomIndexEXT];
    bool inside = gl_HitKindEXT == HIT_INSIDE;
    vec3 normal = normalize(outward * mat3(gl_WorldToObjectEXT));
    if (inside) normal = -normal;

    surface.position = gl_WorldRayOriginEXT + gl_HitTEXT * gl_WorldRayDirectionEXT;
    surface.previous_position = instance.previous_world_from_object * vec4(hit_position(), 1.0);
    // A point along a ray is off by the rounding of the way to it.
    surface.position_error = error + 4e-7 * gl_HitTEXT;
    surface.thickness = 0.0;
    surface.geometric_normal = normal;
    // A found normal may turn away from the viewer a little; triangles' shading normals are lifted likewise.
    const float horizon = 0.01;
    float facing = -dot(normal, gl_WorldRayDirectionEXT);
    surface.normal = facing < horizon ? normalize(normal - (horizon - facing) * gl_WorldRayDirectionEXT) : normal;

    surface.kind = SURFACE_VIRTUAL;
    surface.flags = ((material.flags & MATERIAL_UNLIT) != 0 ? SURFACE_FLAG_UNLIT : 0) |
                    (inside ? SURFACE_FLAG_BACK_FACE | SURFACE_FLAG_INSIDE : 0) | transmission_flags(material.transmission);
    surface.distance = gl_HitTEXT;
    surface.footprint = hit_footprint();
    vec4 base = material.base_color * color;
    surface.base_color = base.rgb;
    surface.alpha = (material.flags & MATERIAL_ALPHA_BLEND) != 0 ? clamp(base.a, 0.0, 1.0) : 1.0;
    surface.emissive = material.emissive;
    surface.roughness = material.roughness;
    surface.metallic = material.metallic;
    surface.occlusion = 1.0;
    surface.material = material_id;
    surface.instance = gl_InstanceCustomIndexEXT;
}

#endif
