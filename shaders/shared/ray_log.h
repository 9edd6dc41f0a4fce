// Rays as they were traced, to be traced again with nothing round them: what a frame's rays cost by themselves.
#ifndef FOVERAY_SHARED_RAY_LOG_H
#define FOVERAY_SHARED_RAY_LOG_H

#include "shaders/shared/light_layers.h"

FOVERAY_SHARED_BEGIN

struct LoggedRay {
    vec3 origin;
    float t_min;  // ray_cone.h
    vec3 direction;
    float t_max;
    uint flags_and_mask;  // flags of traceRayEXT in the upper 24 bits
};

// Begins with VkTraceRaysIndirectCommandKHR; LoggedRays follow.
struct RayLog {
    uint count;
    uint height;
    uint depth;
    uint most;  // that there is room for
};

// Behind the counters stands the log's address, low word first; 0: none is kept.
FOVERAY_CONST uint RAY_LOG_ADDRESS_AT = RAY_COUNTER_KINDS * RAY_COUNTER_SLOTS;

struct BareRaysPush {
    uint64_t log;  // RayLog
};

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(LoggedRay) == 36 && sizeof(RayLog) == 16 && sizeof(BareRaysPush) == 8);
}  // namespace foveray::shared
#else
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LoggedRays {
    RayLog log;
    LoggedRay at[];
};
#endif

#endif
