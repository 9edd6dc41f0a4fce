#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/shared/ray_cone.h"
#include "shaders/shared/scene.h"
#include "shaders/shared/surface.h"

layout(shaderRecordEXT, scalar) buffer RecordBlock { CatcherRecord record; };
hitAttributeEXT vec2 barycentrics;
layout(location = 0) rayPayloadInEXT Surface surface;

void main() {
    UintArray indices = UintArray(record.indices);
    Vec3Array positions = Vec3Array(record.positions);
    vec3 object[3];
    for (uint i = 0; i < 3; ++i) object[i] = positions.at[indices.at[3 * gl_PrimitiveID + i]];
    mat3 linear = mat3(gl_ObjectToWorldEXT);
    vec3 geometric = normalize(cross(linear * (object[1] - object[0]), linear * (object[2] - object[0])));
    if (dot(geometric, gl_WorldRayDirectionEXT) > 0.0) geometric = -geometric;
    vec3 point = object[0] * (1.0 - barycentrics.x - barycentrics.y) + object[1] * barycentrics.x +
                 object[2] * barycentrics.y;

    surface.kind = SURFACE_REAL;
    surface.flags = gl_HitKindEXT == gl_HitKindBackFacingTriangleEXT ? SURFACE_FLAG_BACK_FACE | SURFACE_FLAG_INSIDE : 0;
    surface.position = gl_ObjectToWorldEXT * vec4(point, 1.0);
    surface.previous_position = InstanceArray(record.instances).at[gl_InstanceCustomIndexEXT]
                                    .previous_world_from_object * vec4(point, 1.0);
    surface.normal = geometric;
    surface.geometric_normal = geometric;
    surface.footprint = ray_cone_width(ray_cone_of(gl_RayTminEXT), gl_HitTEXT);
    surface.distance = gl_HitTEXT;
    surface.base_color = record.albedo;
    surface.alpha = 1.0;
    surface.emissive = vec3(0.0);
    surface.roughness = record.roughness;
    surface.metallic = record.reflectance;
    surface.occlusion = 1.0;
    surface.material = record.surface;
    surface.instance = gl_InstanceCustomIndexEXT;
    surface.position_error = 0.0;
    surface.thickness = 0.0;
}
