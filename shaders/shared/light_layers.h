// Light a sample: docs/architecture.md, "Mixed reality".
#ifndef FOVERAY_SHARED_LIGHT_LAYERS_H
#define FOVERAY_SHARED_LIGHT_LAYERS_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

struct LightSample {
    vec3 radiance;  // of virtual things, premultiplied by coverage
    float coverage;
    vec3 transmittance;  // what is left of the real surface's light: virtual shadows
    float distance;      // along the ray to the nearest surface, metres; < 0: none
    vec3 added;          // light that virtual things add to the real surface
    float valid;         // 0: culled
};

// The part of a sample's light whose shadows are noisy, apart from the rest: how much arrives is noise, what it falls
// on is not. So it can be smoothed without blurring textures and mirror images (Heitz, Hill,
// McGuire 2018, "Combining analytic direct illumination and stochastic shadows").
struct ShadowedLight {
    uvec2 open;       // of the first surface, if nothing were in the way, packed halves: of a virtual one radiance, of
                      // a real one the share in `transmittance`
    uint visibility;  // the part of it that arrives, RGB: pack_visibility
};

// Roots in 10 bits each: dark shadows are where steps show.
FOVERAY_INLINE uint pack_visibility(vec3 v) {
    uvec3 root = uvec3(sqrt(clamp(v, 0.0f, 1.0f)) * 1023.0f + 0.5f);
    return root.x | root.y << 10u | root.z << 20u;
}

FOVERAY_INLINE vec3 unpack_visibility(uint packed_roots) {
    vec3 root = vec3(uvec3(packed_roots, packed_roots >> 10u, packed_roots >> 20u) & 1023u) / 1023.0f;
    return root * root;
}

// Rays traced, by kind. Each is spread over slots, so that neighbouring samples do not wait for one another: on an H200
// a slot for 32 of them cost as much as the rays. The CPU sums the slots.
FOVERAY_CONST uint RAY_COUNTER_SLOTS = 1024u;
FOVERAY_CONST uint COUNT_PRIMARY = 0u;
FOVERAY_CONST uint COUNT_SHADOW = 1u;
FOVERAY_CONST uint COUNT_REFLECTION = 2u;
FOVERAY_CONST uint COUNT_TRANSPARENT = 3u;
FOVERAY_CONST uint COUNT_OCCLUSION = 4u;
FOVERAY_CONST uint COUNT_PROBE = 5u;
FOVERAY_CONST uint RAY_COUNTER_KINDS = 6u;

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(LightSample) == 48 && offsetof(LightSample, valid) == 44);
static_assert(sizeof(ShadowedLight) == 12 && offsetof(ShadowedLight, visibility) == 8);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(LightSampleArray, LightSample);
FOVERAY_ARRAY(ShadowedLightArray, ShadowedLight);
FOVERAY_ARRAY(CounterArray, uint);  // [kind * RAY_COUNTER_SLOTS + sample % RAY_COUNTER_SLOTS]
#endif

#endif
