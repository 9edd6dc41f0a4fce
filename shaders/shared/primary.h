// Push constants of primary.rgen.
#ifndef FOVERAY_SHARED_PRIMARY_H
#define FOVERAY_SHARED_PRIMARY_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

struct PrimaryPush {
    uint64_t grid;      // SampleGrid
    uint64_t surfaces;  // StoredSurface[], by sample; written
    uint64_t counters;  // uint[RAY_COUNTER_KINDS][RAY_COUNTER_SLOTS], added to
    uint first_sample;  // of the launch, whose rows follow one another
    uint pad;
};

FOVERAY_SHARED_END

#endif
