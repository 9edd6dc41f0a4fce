// Light from behind everything virtual. The including shader has `push` (LightingPush).
#ifndef FOVERAY_RENDER_SURROUNDINGS_GLSL
#define FOVERAY_RENDER_SURROUNDINGS_GLSL

#include "shaders/passthrough/room.glsl"
#include "shaders/render/indirect.glsl"
#include "shaders/shared/scene.h"

// The camera's picture along a ray; false where the camera did not see.
bool camera_radiance(vec3 origin, vec3 direction, out vec3 radiance) {
    radiance = vec3(0.0);
    if (push.room == 0) return false;
    RoomParamsRef room = RoomParamsRef(push.room);
    mat4 stage_from_world = room.value.stage_from_world;
    return room_radiance(room, (stage_from_world * vec4(origin, 1.0)).xyz, mat3(stage_from_world) * direction, radiance);
}

vec3 background(vec3 origin, vec3 direction, float roughness) {
    vec3 radiance;
    return camera_radiance(origin, direction, radiance) ? radiance : environment_light(direction, roughness);
}

#endif
