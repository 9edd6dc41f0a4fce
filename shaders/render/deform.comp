// Morph targets, then linear blend skinning: glTF 2.0 sections 3.7.2.2 and 3.7.3. A thread a vertex.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/shared/deform.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform PushBlock { DeformPush push; };

vec3 unit(vec3 v) {
    float l = length(v);
    return l > 0.0 ? v / l : v;
}

void main() {
    uint vertex = gl_GlobalInvocationID.x;
    uint count = push.vertex_count;
    if (vertex >= count) return;
    vec3 position = Vec3Array(push.rest_positions).at[vertex];
    VertexAttributes attributes = VertexAttributesArray(push.rest_attributes).at[vertex];
    vec3 normal = attributes.normal;
    vec3 tangent = attributes.tangent.xyz;

    Vec3Array targets = Vec3Array(push.targets);
    for (uint t = 0; t < push.target_count; ++t) {
        float weight = WeightArray(push.morph_weights).at[t];
        if (weight == 0.0) continue;
        uint first = 3 * t * count + vertex;
        position += weight * targets.at[first];
        normal += weight * targets.at[first + count];
        tangent += weight * targets.at[first + 2 * count];
    }

    if (push.skin != 0) {
        SkinVertex skin = SkinVertexArray(push.skin).at[vertex];
        Mat4Array joints = Mat4Array(push.joints);
        mat4 world_from_object = skin.weights.x * joints.at[skin.joints.x & 0xFFFFu] +
                                 skin.weights.y * joints.at[skin.joints.x >> 16] +
                                 skin.weights.z * joints.at[skin.joints.y & 0xFFFFu] +
                                 skin.weights.w * joints.at[skin.joints.y >> 16];
        mat3 linear = mat3(world_from_object);
        // The cofactor matrix: the inverse transpose times the determinant, and defined even when that is 0.
        mat3 cofactors = mat3(cross(linear[1], linear[2]), cross(linear[2], linear[0]), cross(linear[0], linear[1]));
        if (dot(linear[0], cofactors[0]) < 0.0) cofactors = -cofactors;
        position = (world_from_object * vec4(position, 1.0)).xyz;
        normal = cofactors * normal;
        tangent = linear * tangent;
    }
    Vec3Array(push.positions).at[vertex] = position;
    VertexAttributesArray(push.attributes).at[vertex].normal = unit(normal);
    VertexAttributesArray(push.attributes).at[vertex].tangent.xyz = unit(tangent);
}
