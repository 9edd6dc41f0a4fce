// What a ray found, before any light: payload of surface rays and one element a sample of the primary stage.
#ifndef FOVERAY_SHARED_SURFACE_H
#define FOVERAY_SHARED_SURFACE_H

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

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(Surface) == 120 && offsetof(Surface, thickness) == 116);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(SurfaceArray, Surface);

uint transmission_flags(float transmission) {
    uint share = uint(clamp(transmission, 0.0, 1.0) * 255.0 + 0.5);
    return share == 0 ? 0 : SURFACE_FLAG_TRANSMISSIVE | share << 24;
}
#endif

#endif
