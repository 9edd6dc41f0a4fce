#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "shaders/render/triangle_hit.glsl"
#include "shaders/shared/ray_cone.h"
#include "shaders/shared/surface.h"

layout(location = 0) rayPayloadInEXT Surface surface;

// Inverse transpose: keeps a normal perpendicular to its surface, and its side, under any transform.
vec3 world_normal(vec3 object_normal) { return normalize(object_normal * mat3(gl_WorldToObjectEXT)); }

vec3 mapped_normal(Material material, TexturePoint p, vec3 object_normal, vec4 tangent) {
    vec3 n = world_normal(object_normal);
    if (material.normal_texture.texture == NO_TEXTURE || dot(tangent.xyz, tangent.xyz) == 0.0) return n;
    vec3 bitangent = tangent.w * cross(object_normal, tangent.xyz);
    vec3 t = normalize(mat3(gl_ObjectToWorldEXT) * tangent.xyz);
    vec3 b = normalize(mat3(gl_ObjectToWorldEXT) * bitangent);
    vec3 m = sample_texture(material.normal_texture, p).xyz * 2.0 - 1.0;
    m.xy *= material.normal_scale;
    return normalize(m.x * t + m.y * b + m.z * n);
}

void main() {
    Corners c = hit_corners();
    VertexAttributesArray attributes = VertexAttributesArray(record.attributes);
    VertexAttributes v[3];
    vec3 corner[3];
    Vec3Array positions = Vec3Array(record.positions);
    for (uint i = 0; i < 3; ++i) {
        v[i] = attributes.at[c.index[i]];
        corner[i] = gl_ObjectToWorldEXT * vec4(positions.at[c.index[i]], 1.0);
    }
    Material material = MaterialArray(record.materials).at[record.material];
    InstanceData instance = InstanceArray(record.instances).at[gl_InstanceCustomIndexEXT];
    bool back = gl_HitKindEXT == gl_HitKindBackFacingTriangleEXT;
    vec3 view = -gl_WorldRayDirectionEXT;
    float footprint = ray_cone_width(ray_cone_of(gl_RayTminEXT), gl_HitTEXT);

    // Interpolated corners are exact to rounding, a point along the ray is not.
    surface.position = gl_ObjectToWorldEXT * vec4(interpolate(positions, c), 1.0);
    surface.previous_position =
        instance.previous_world_from_object * vec4(interpolate(Vec3Array(record.previous_positions), c), 1.0);

    vec3 geometric = normalize(cross(corner[1] - corner[0], corner[2] - corner[0]));
    surface.geometric_normal = dot(geometric, view) < 0.0 ? -geometric : geometric;

    TexturePoint p = texture_point(v, c.weight, corner, gl_WorldRayDirectionEXT, footprint);
    vec3 object_normal =
        normalize(v[0].normal * c.weight.x + v[1].normal * c.weight.y + v[2].normal * c.weight.z);
    vec4 tangent = v[0].tangent * c.weight.x + v[1].tangent * c.weight.y + v[2].tangent * c.weight.z;
    tangent.w = tangent.w < 0.0 ? -1.0 : 1.0;
    vec3 normal = mapped_normal(material, p, object_normal, tangent);
    if (back) normal = -normal;
    // A shading normal that turns away from the viewer is lifted to the horizon.
    const float horizon = 0.01;
    float facing = dot(normal, view);
    if (facing < horizon) normal = normalize(normal + (horizon - facing) * view);
    surface.normal = normal;

    vec4 color = base_color_at(material, v, c.weight, p);
    surface.base_color = color.rgb;
    surface.alpha = (material.flags & MATERIAL_ALPHA_BLEND) != 0 ? clamp(color.a, 0.0, 1.0) : 1.0;
    surface.metallic = material.metallic;
    surface.roughness = material.roughness;
    if (material.metallic_roughness_texture.texture != NO_TEXTURE) {
        vec4 texel = sample_texture(material.metallic_roughness_texture, p);
        surface.roughness *= texel.g;
        surface.metallic *= texel.b;
    }
    surface.emissive = material.emissive;
    if (material.emissive_texture.texture != NO_TEXTURE) {
        surface.emissive *= sample_texture(material.emissive_texture, p).rgb;
    }
    surface.occlusion = 1.0;
    if (material.occlusion_texture.texture != NO_TEXTURE) {
        surface.occlusion +=
            material.occlusion_strength * (sample_texture(material.occlusion_texture, p).r - 1.0);
    }

    surface.kind = SURFACE_VIRTUAL;
    surface.flags = ((material.flags & MATERIAL_UNLIT) != 0 ? SURFACE_FLAG_UNLIT : 0) |
                    (back ? SURFACE_FLAG_BACK_FACE : 0) |
                    (back && (material.flags & MATERIAL_DOUBLE_SIDED) == 0 ? SURFACE_FLAG_INSIDE : 0);
    if ((material.flags & MATERIAL_TRANSMISSIVE) != 0) {
        float transmission = material.transmission;
        if (material.transmission_texture.texture != NO_TEXTURE) {
            transmission *= sample_texture(material.transmission_texture, p).r;
        }
        surface.flags |= transmission_flags(transmission);
    }
    surface.distance = gl_HitTEXT;
    surface.footprint = footprint;
    surface.material = record.material;
    surface.instance = gl_InstanceCustomIndexEXT;
    surface.position_error = 0.0;
    surface.thickness = 0.0;
}
