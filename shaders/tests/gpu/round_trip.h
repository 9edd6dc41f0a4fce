// Push constants of round_trip.comp.
#ifndef FOVERAY_TESTS_ROUND_TRIP_H
#define FOVERAY_TESTS_ROUND_TRIP_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

struct RoundTripPush {
    uint64_t structs;  // an array of the struct with number `which`
    uint64_t words;    // uint[element][words_per_struct]: the bits of its fields, in order
    uint which;
    uint words_per_struct;
    uint to_structs;  // 0: structs to words, 1: words to structs
    uint pad;
};

FOVERAY_SHARED_END

#endif
