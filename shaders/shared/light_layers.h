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

// Rays traced, by kind. Each is spread over slots, so that neighbouring samples do not wait for one another: on an H200
// a slot for 32 of them cost as much as the rays. The CPU sums the slots.
FOVERAY_CONST uint RAY_COUNTER_SLOTS = 1024u;
FOVERAY_CONST uint COUNT_PRIMARY = 0u;
FOVERAY_CONST uint COUNT_SHADOW = 1u;
FOVERAY_CONST uint COUNT_REFLECTION = 2u;
FOVERAY_CONST uint COUNT_TRANSPARENT = 3u;
FOVERAY_CONST uint RAY_COUNTER_KINDS = 4u;

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(LightSample) == 48 && offsetof(LightSample, valid) == 44);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(LightSampleArray, LightSample);
FOVERAY_ARRAY(CounterArray, uint);  // [kind * RAY_COUNTER_SLOTS + sample % RAY_COUNTER_SLOTS]
#endif

#endif
