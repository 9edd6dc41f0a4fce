// Rays whose hits tell everything that the hit shaders saw.
#ifndef FOVERAY_TESTS_PROBE_H
#define FOVERAY_TESTS_PROBE_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint PROBE_RAY_TYPES = 3u;
FOVERAY_CONST uint PROBE_RECORD_WORDS = 8u;

// Which shader wrote the hit.
FOVERAY_CONST uint PROBE_NOTHING = 0u;
FOVERAY_CONST uint PROBE_MISS = 100u;  // + ray type
FOVERAY_CONST uint PROBE_WIDE_FIRST = 1u;
FOVERAY_CONST uint PROBE_WIDE_SECOND = 2u;
FOVERAY_CONST uint PROBE_NARROW = 3u;
FOVERAY_CONST uint PROBE_SPHERE = 4u;

struct ProbeRay {
    vec3 origin;
    float t_min;
    vec3 direction;
    float t_max;
    uint mask;
    uint ray_type;
    uint flags;
};

struct ProbeHit {
    float distance;
    uint shader;
    uint instance;
    uint custom_index;
    uint geometry;
    uint primitive;
    uint any_hits;   // any-hit shaders that ran
    uint record[8];  // the words of the record's fields
};

struct ProbePush {
    uint64_t rays;
    uint64_t hits;
};

struct WideRecord {
    uint64_t address;
    uint id;
    float value;
    vec3 vector;
    uint last;
};

struct NarrowRecord {
    uint id;
};

struct ProbeSphereRecord {
    vec3 center;
    float radius;
    uint id;
};

FOVERAY_SHARED_END

#ifndef __cplusplus
FOVERAY_ARRAY(ProbeRayArray, ProbeRay);
FOVERAY_ARRAY(ProbeHitArray, ProbeHit);
#endif

#endif
