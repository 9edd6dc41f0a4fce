// Keeps rays for the benchmark of bare rays. The including shader has `push` with `counters`.
#ifndef FOVERAY_RENDER_LOG_RAYS_GLSL
#define FOVERAY_RENDER_LOG_RAYS_GLSL

#include "shaders/shared/ray_cone.h"
#include "shaders/shared/ray_log.h"

void log_ray(uint flags, uint mask, vec3 origin, vec3 direction, float t_max, RayCone cone) {
    CounterArray counters = CounterArray(push.counters);
    uint64_t address = packUint2x32(uvec2(counters.at[RAY_LOG_ADDRESS_AT], counters.at[RAY_LOG_ADDRESS_AT + 1]));
    if (address == 0ul) return;
    LoggedRays rays = LoggedRays(address);
    uint place = atomicAdd(rays.log.count, 1);
    if (place < rays.log.most) rays.at[place] = LoggedRay(origin, ray_cone_t_min(cone), direction, t_max, flags << 8 | mask);
}

#endif
