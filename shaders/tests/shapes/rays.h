// Any rays into a scene, and what they find.
#ifndef FOVERAY_TESTS_SHAPES_RAYS_H
#define FOVERAY_TESTS_SHAPES_RAYS_H

#include "shaders/shared/ray_cone.h"
#include "shaders/shared/surface.h"

FOVERAY_SHARED_BEGIN

struct TestRay {
    vec3 origin;
    float t_max;
    vec3 direction;  // unit length
    float shadow_t_max;
    RayCone cone;
};

struct RayAnswer {
    Surface surface;
    vec3 transmittance;
};

// What the debug hit shaders found in the record that the ray led them to.
FOVERAY_CONST uint DEBUG_RECORD_WORDS = 32u;

struct RecordSeen {
    uint geometry_type;  // of the closest-hit shader that ran; or NO_TYPE
    uint ray_types;      // one bit for each ray type whose any-hit shader ran
    uint instance;
    uint geometry;
    uint words[32];
};

FOVERAY_CONST uint NO_TYPE = 0xFFFFFFFFu;

struct RaysPush {
    uint64_t rays;     // TestRay[]
    uint64_t answers;  // RayAnswer[], or RecordSeen[] by ray and ray type
};

FOVERAY_SHARED_END

#ifndef __cplusplus
FOVERAY_ARRAY(TestRayArray, TestRay);
FOVERAY_ARRAY(RayAnswerArray, RayAnswer);
FOVERAY_ARRAY(RecordSeenArray, RecordSeen);
#endif

#endif
