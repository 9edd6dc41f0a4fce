// The frame's ray counters.
#ifndef FOVERAY_RENDER_COUNT_RAYS_GLSL
#define FOVERAY_RENDER_COUNT_RAYS_GLSL

#include "shaders/shared/light_layers.h"

// `sample_index` chooses the slot: neighbouring ones do not wait for one another.
void count_rays(uint64_t counters, uint kind, uint sample_index, uint rays) {
    if (rays == 0) return;
    atomicAdd(CounterArray(counters).at[kind * RAY_COUNTER_SLOTS + sample_index % RAY_COUNTER_SLOTS], rays);
}

#endif
