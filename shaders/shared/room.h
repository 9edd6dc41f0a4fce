// The real room as shaders see it: what passthrough knows and lighting may ask. Stage space, linear radiance.
#ifndef FOVERAY_SHARED_ROOM_H
#define FOVERAY_SHARED_ROOM_H

#include "shaders/shared/portable.h"

FOVERAY_SHARED_BEGIN

FOVERAY_CONST uint NO_PICTURE = 0xFFFFFFFFu;
FOVERAY_CONST uint CAMERA_PINHOLE = 0u;
FOVERAY_CONST uint CAMERA_FISHEYE = 1u;
FOVERAY_CONST uint MAX_PROXIES = 16u;

// A real surface as an oriented box; a plane is a box with one half extent of 0.
struct RoomProxy {
    vec3 center;
    vec3 half_x;
    vec3 half_y;
    vec3 half_z;
};

struct RoomParams {
    mat4 camera_from_stage;  // at capture time; x right, y up, -z forward
    mat4 stage_from_world;
    vec2 focal;        // pixels
    vec2 principal;    // pixels, (0, 0) is the top left corner of the top left pixel
    vec2 picture_size;  // pixels
    uint picture;       // texture of the newest picture, or NO_PICTURE; sampling linearises
    uint model;         // CAMERA_PINHOLE or CAMERA_FISHEYE
    float distortion[8];  // OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6, or fisheye k1 k2 k3 k4
    float max_angle;      // radians off the axis where the model stops being valid
    float far_distance;   // metres: where the room is taken to be if no proxy is hit
    float exposure;       // scales the picture's linear values
    uint proxy_count;
    RoomProxy proxies[16];
};

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(RoomProxy) == 48 && offsetof(RoomProxy, half_z) == 36);
static_assert(sizeof(RoomParams) == 976 && offsetof(RoomParams, proxies) == 208);
}  // namespace foveray::shared
#else
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer RoomParamsRef { RoomParams value; };
#endif

#endif
