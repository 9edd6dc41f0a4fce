#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/engine/textures.glsl"
#include "shaders/tests/gpu/sample.h"

layout(local_size_x = 4) in;
layout(push_constant, scalar) uniform Push { SamplePush push; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    SampleUse use = SampleUseArray(push.uses).at[i];
    Vec4Array(push.colors).at[i] = textureLod(textures[nonuniformEXT(use.texture)], vec2(use.u, use.v), use.level);
}
