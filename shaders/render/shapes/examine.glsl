// What the examinations of users' shapes share.
#ifndef FOVERAY_RENDER_SHAPES_EXAMINE_GLSL
#define FOVERAY_RENDER_SHAPES_EXAMINE_GLSL

#include "shaders/shared/examination.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform PushBlock { ExaminationPush push; };

UserRecord record = UserRecordArray(push.record).at[0];

void report_finding(uint which, vec3 at) {
    if (atomicAdd(FindingArray(push.findings).at[which].count, 1) == 0) FindingArray(push.findings).at[which].at = at;
}

bool is_number(float x) { return !isnan(x) && !isinf(x); }
bool is_number(vec3 v) { return is_number(v.x) && is_number(v.y) && is_number(v.z); }

// How far outside the bounds counts as outside.
float examination_tolerance() { return 1e-3 * distance(record.bounds_min, record.bounds_max); }

bool is_outside(vec3 p) {
    float tolerance = examination_tolerance();
    return any(lessThan(p, record.bounds_min - tolerance)) || any(greaterThan(p, record.bounds_max + tolerance));
}

#endif
