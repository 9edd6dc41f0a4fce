// The scene as shaders see it. World space, metres, linear Rec. 709.
#ifndef FOVERAY_SHARED_SCENE_H
#define FOVERAY_SHARED_SCENE_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint NO_TEXTURE = 0xFFFFFFFFu;

// A texture with its place on the surface: uv' = offset + uv.x * u_axis + uv.y * v_axis (KHR_texture_transform).
struct TextureUse {
    uint texture;  // index into the texture table, or NO_TEXTURE
    uint uv_set;   // 0 or 1
    vec2 u_axis;
    vec2 v_axis;
    vec2 offset;
};

FOVERAY_CONST uint MATERIAL_ALPHA_MASK = 1u;
FOVERAY_CONST uint MATERIAL_ALPHA_BLEND = 2u;
FOVERAY_CONST uint MATERIAL_DOUBLE_SIDED = 4u;
FOVERAY_CONST uint MATERIAL_UNLIT = 8u;
FOVERAY_CONST uint MATERIAL_TRANSMISSIVE = 16u;
FOVERAY_CONST uint MATERIAL_SOLID = 32u;  // transmissive, and its surface encloses it; otherwise it is a thin sheet

// glTF 2.0 metallic-roughness.
struct Material {
    vec4 base_color;
    vec3 emissive;
    float metallic;
    float roughness;
    float normal_scale;
    float occlusion_strength;
    float alpha_cutoff;
    uint flags;
    TextureUse base_color_texture;
    TextureUse metallic_roughness_texture;
    TextureUse normal_texture;
    TextureUse occlusion_texture;
    TextureUse emissive_texture;
    float transmission;
    float ior;
    vec3 attenuation;  // per metre inside of a solid: exp(-attenuation * metres) is left
    TextureUse transmission_texture;
};

// Positions lie apart (tightly packed vec3), because acceleration structures read them.
struct VertexAttributes {
    vec3 normal;
    vec4 tangent;  // w: sign of the bitangent
    vec2 uv0;
    vec2 uv1;
    uvec2 color;  // linear RGBA as four halves (packHalf2x16)
};

// Shader record of a triangle geometry.
struct TriangleRecord {
    uint64_t positions;           // vec3[]
    uint64_t previous_positions;  // vec3[] of the frame before; the same buffer unless the mesh deforms
    uint64_t indices;             // uint[3 * triangle]
    uint64_t attributes;          // VertexAttributes[]
    uint64_t materials;           // Material[]
    uint64_t instances;           // InstanceData[]
    uint material;
    uint pad;
};

// Shader record of a real surface: an invisible catcher.
struct CatcherRecord {
    uint64_t positions;  // vec3[]
    uint64_t indices;    // uint[]
    uint64_t instances;  // InstanceData[]
    vec3 albedo;
    float roughness;
    float reflectance;  // mirror reflection at normal incidence; 0: a matte surface
    uint surface;       // id given by the scene
};

// By gl_InstanceCustomIndexEXT.
struct InstanceData {
    mat4x3 previous_world_from_object;
    uint node;  // id given by the scene
};

FOVERAY_CONST uint LIGHT_POINT = 0u;
FOVERAY_CONST uint LIGHT_SPOT = 1u;
FOVERAY_CONST uint LIGHT_DIRECTIONAL = 2u;
// Lights with an area; the others come before them.
FOVERAY_CONST uint LIGHT_RECTANGLE = 3u;  // shines to the side of its normal, cross(half_u, half_v)
FOVERAY_CONST uint LIGHT_BOX = 4u;        // half axes half_u, half_v and range * direction
FOVERAY_CONST uint LIGHT_SPHERE = 5u;     // of radius `range`

struct Light {
    vec3 position;  // world; centre of an area light
    uint type;
    vec3 direction;  // in which it shines, unit length; a box's third axis
    float range;     // 0: unlimited (KHR_lights_punctual); see LIGHT_BOX, LIGHT_SPHERE
    vec3 intensity;  // W/sr (point, spot), W/m² (directional), radiance W/(m² sr) (areas)
    float cos_inner;
    vec3 half_u;
    float cos_outer;
    vec3 half_v;
    uint number;  // its own whatever lights come and go: which samples it takes depends on it
};

// Light from everywhere that nothing else is. The picture is equirectangular: u = 0.5 + atan2(x, -z) / 2π,
// v = acos(y) / π, levels are blurred for roughness 0 … 1.
struct Environment {
    mat3 environment_from_world;
    vec3 constant;         // radiance where there is no picture
    uint texture;          // or NO_TEXTURE
    float intensity;
    float level_count;
    vec3 irradiance_sh[9];  // of the picture or the constant; cosine-convolved, E(n) = Σ sh[i] Y_i(n)
};

struct SceneData {
    uint64_t lights;     // Light[]
    uint64_t materials;  // Material[]
    uint light_count;
    uint catcher_count;
    Environment environment;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(TextureUse) == 32 && offsetof(TextureUse, offset) == 24);
static_assert(sizeof(Material) == 264 && offsetof(Material, transmission_texture) == 232);
static_assert(sizeof(VertexAttributes) == 52 && offsetof(VertexAttributes, color) == 44);
static_assert(sizeof(TriangleRecord) == 56 && offsetof(TriangleRecord, pad) == 52);
static_assert(sizeof(CatcherRecord) == 48 && offsetof(CatcherRecord, surface) == 44);
static_assert(sizeof(InstanceData) == 52 && offsetof(InstanceData, node) == 48);
static_assert(sizeof(Light) == 80 && offsetof(Light, number) == 76);
static_assert(sizeof(Environment) == 168 && offsetof(Environment, irradiance_sh) == 60);
static_assert(sizeof(SceneData) == 192 && offsetof(SceneData, environment) == 24);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(MaterialArray, Material);
FOVERAY_ARRAY(VertexAttributesArray, VertexAttributes);
FOVERAY_ARRAY(Vec3Array, vec3);
FOVERAY_ARRAY(UintArray, uint);
FOVERAY_ARRAY(InstanceArray, InstanceData);
FOVERAY_ARRAY(LightArray, Light);
FOVERAY_ARRAY(SceneDataArray, SceneData);
#endif

#endif
