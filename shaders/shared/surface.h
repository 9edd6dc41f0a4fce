// What a ray found, before any light: payload of surface rays, and, stored smaller, one element a sample of the primary
// stage.
#ifndef FOVERAY_SHARED_SURFACE_H
#define FOVERAY_SHARED_SURFACE_H

#include "shaders/shared/halves.h"
#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint SURFACE_NONE = 0u;     // the ray left the scene
FOVERAY_CONST uint SURFACE_VIRTUAL = 1u;
FOVERAY_CONST uint SURFACE_REAL = 2u;     // a catcher
FOVERAY_CONST uint SURFACE_CULLED = 3u;   // not traced: no view shows it

FOVERAY_CONST uint SURFACE_FLAG_UNLIT = 1u;
FOVERAY_CONST uint SURFACE_FLAG_BACK_FACE = 2u;
FOVERAY_CONST uint SURFACE_FLAG_TRANSMISSIVE = 4u;  // flags' highest eight bits: the share of 255 that passes
FOVERAY_CONST uint SURFACE_FLAG_INSIDE = 8u;  // the ray comes from within something solid

struct Surface {
    vec3 position;  // world
    uint kind;
    vec3 normal;  // shading normal, unit length, on the ray's side
    uint flags;
    vec3 geometric_normal;  // unit length, on the ray's side
    float distance;         // along the ray, metres
    vec3 base_color;        // linear; of a catcher: its diffuse albedo
    float alpha;            // 1 unless the material blends
    vec3 emissive;
    float roughness;  // perceptual
    vec3 previous_position;  // where this point was in the frame before, world
    float metallic;          // of a catcher: its reflectance
    float footprint;         // width of the ray's cone at the hit, metres
    float occlusion;         // from the material's texture; 1: open
    uint material;           // id given by the scene
    uint instance;
    float position_error;  // how far off the true surface `position` may be, besides rounding; metres
    float thickness;       // 0, or what lies behind begins so far behind `position` along the ray; metres
};

// Where and how it lies in full, what it is made of in halves.
struct StoredSurface {
    vec3 position;
    uint kind_and_flags;  // kind_and_flags()
    vec3 normal;
    float distance;
    vec3 geometric_normal;
    uint material;
    uint instance;
    uvec2 base_color_and_alpha;
    uvec2 emissive_and_roughness;
    uvec2 motion_and_metallic;  // from the previous position, metres
    uint footprint_and_occlusion;
    uint error_and_thickness;
};

// Leaves the bits of the share that passes, and of the flags.
FOVERAY_INLINE uint kind_and_flags(uint kind, uint flags) { return kind << 16u | flags; }

FOVERAY_INLINE StoredSurface stored_surface(Surface s) {
    StoredSurface t;
    t.position = s.position;
    t.kind_and_flags = kind_and_flags(s.kind, s.flags);
    t.normal = s.normal;
    t.distance = s.distance;
    t.geometric_normal = s.geometric_normal;
    t.material = s.material;
    t.instance = s.instance;
    t.base_color_and_alpha = pack_halves(vec4(s.base_color, s.alpha));
    t.emissive_and_roughness = pack_halves(vec4(min(s.emissive, vec3(LARGEST_HALF)), s.roughness));
    t.motion_and_metallic = pack_halves(vec4(s.position - s.previous_position, s.metallic));
    t.footprint_and_occlusion = packHalf2x16(vec2(s.footprint, s.occlusion));
    t.error_and_thickness = packHalf2x16(vec2(s.position_error, s.thickness));
    return t;
}

FOVERAY_INLINE Surface surface_of(StoredSurface t) {
    Surface s;
    vec4 color = unpack_halves(t.base_color_and_alpha);
    vec4 emissive = unpack_halves(t.emissive_and_roughness);
    vec4 motion = unpack_halves(t.motion_and_metallic);
    vec2 footprint = unpackHalf2x16(t.footprint_and_occlusion);
    vec2 error = unpackHalf2x16(t.error_and_thickness);
    s.position = t.position;
    s.kind = t.kind_and_flags >> 16u & 255u;
    s.normal = t.normal;
    s.flags = t.kind_and_flags & 0xFF00FFFFu;
    s.geometric_normal = t.geometric_normal;
    s.distance = t.distance;
    s.base_color = vec3(color);
    s.alpha = color.w;
    s.emissive = vec3(emissive);
    s.roughness = emissive.w;
    s.previous_position = t.position - vec3(motion);
    s.metallic = motion.w;
    s.footprint = footprint.x;
    s.occlusion = footprint.y;
    s.material = t.material;
    s.instance = t.instance;
    s.position_error = error.x;
    s.thickness = error.y;
    return s;
}

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(Surface) == 120 && offsetof(Surface, thickness) == 116);
static_assert(sizeof(StoredSurface) == 84 && offsetof(StoredSurface, error_and_thickness) == 80);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(SurfaceArray, StoredSurface);

uint transmission_flags(float transmission) {
    uint share = uint(clamp(transmission, 0.0, 1.0) * 255.0 + 0.5);
    return share == 0 ? 0 : SURFACE_FLAG_TRANSMISSIVE | share << 24;
}
#endif

#endif
