// What deform.comp reads.
#ifndef FOVERAY_SHARED_DEFORM_H
#define FOVERAY_SHARED_DEFORM_H

#include "shaders/shared/portable.h"
#include "shaders/shared/scene.h"

FOVERAY_SHARED_BEGIN

struct SkinVertex {
    uvec2 joints;  // four 16-bit indices, the first in the low bits of x
    vec4 weights;
};

struct DeformPush {
    uint64_t rest_positions;   // vec3[]
    uint64_t rest_attributes;  // VertexAttributes[]
    uint64_t skin;             // SkinVertex[]; 0: not skinned
    uint64_t targets;          // vec3[target][position, normal, tangent][vertex]
    uint64_t joints;           // mat4[]: world_from_object of each joint
    uint64_t morph_weights;    // float[]
    uint64_t positions;        // vec3[]; written
    uint64_t attributes;       // VertexAttributes[]; normals and tangents are written
    uint vertex_count;
    uint target_count;
};

FOVERAY_SHARED_END

#ifndef __cplusplus
FOVERAY_ARRAY(SkinVertexArray, SkinVertex);
FOVERAY_ARRAY(Mat4Array, mat4);
FOVERAY_ARRAY(WeightArray, float);
#endif

#endif
