#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_GOOGLE_include_directive : require

// Finds the surfaces that may lie in a light's penumbra: the first look was undecided, there or next to it, or found
// something else next to it.
#include "shaders/shared/shadows.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { ShadowPush push; };

#include "shaders/render/penumbra_lists.glsl"

// Neighbours to each side that are asked: what is thinner than the light is met by some of them.
const int REACH = 1;

bool differs(ivec2 place, uint light, uint here) {
    if (push.wraps != 0) place.y = (place.y + int(push.height)) % int(push.height);
    if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, ivec2(push.width, push.height)))) return false;
    uint index = push.first_sample + uint(place.y) * push.width + uint(place.x);
    uint there = VisibilityArray(push.visibility).at[light * push.sample_count + index];
    return there != VISIBILITY_NONE && there != here;
}

bool in_penumbra(ivec2 place, uint light, uint here) {
    if (here == VISIBILITY_NONE) return false;
    if (here == VISIBILITY_MIXED) return true;
    for (int y = -REACH; y <= REACH; ++y) {
        for (int x = -REACH; x <= REACH; ++x) {
            if (differs(place + ivec2(x, y), light, here)) return true;
        }
    }
    return false;
}

void main() {
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    bool inside = place.x < int(push.width) && place.y < int(push.height);
    uint index = push.first_sample + uint(place.y) * push.width + uint(place.x);
    uint64_t list = push.cells == 0 ? push.whole : push.found;
    for (uint light = 0; light < push.light_count; ++light) {
        uint entry = light * push.sample_count + index;
        if (!is_area_light(LightArray(SceneDataArray(push.scene).at[0].lights).at[light])) continue;
        append(list, inside && in_penumbra(place, light, VisibilityArray(push.visibility).at[entry]), entry);
    }
}
