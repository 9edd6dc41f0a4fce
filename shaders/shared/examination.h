// Whether a user's shape keeps its word: what render/user_shapes asks the GPU before the shape may be seen.
#ifndef FOVERAY_SHARED_EXAMINATION_H
#define FOVERAY_SHARED_EXAMINATION_H

#include "shaders/shared/portable.h"
#include "shaders/shared/shapes.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint EXAMINED_SIDE = 32u;  // samples along an edge

FOVERAY_CONST uint FINDING_NOT_A_NUMBER = 0u;
FOVERAY_CONST uint FINDING_OUTSIDE = 1u;     // a surface outside the bounds, or cut off by them
FOVERAY_CONST uint FINDING_WRONG_T = 2u;     // t outside t_min to t_max
FOVERAY_CONST uint FINDING_NO_NORMAL = 3u;   // without length
FOVERAY_CONST uint FINDING_COUNT = 4u;

struct Finding {
    uint count;
    vec3 at;  // one of the places, object space
};

struct ExaminationPush {
    uint64_t record;    // UserRecord
    uint64_t findings;  // Finding[FINDING_COUNT]
    uint count;         // invocations that examine
    uint pad;
};

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(Finding) == 16 && offsetof(Finding, at) == 4);
static_assert(sizeof(ExaminationPush) == 24 && offsetof(ExaminationPush, pad) == 20);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(FindingArray, Finding);
FOVERAY_ARRAY(UserRecordArray, UserRecord);
#endif

#endif
