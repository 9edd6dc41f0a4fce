// Push constants of primary.rgen.
#ifndef FOVERAY_SHARED_PRIMARY_H
#define FOVERAY_SHARED_PRIMARY_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

struct PrimaryPush {
    uint64_t grid;      // SampleGrid
    uint64_t surfaces;  // Surface[], by sample; written
    uint64_t counters;  // uint[RAY_COUNTER_SLOTS][RAY_COUNTER_KINDS], added to
    uint sample_count;
    uint row_length;  // samples in a row of the launch
};

FOVERAY_SHARED_END

#endif
