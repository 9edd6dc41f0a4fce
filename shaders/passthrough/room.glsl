// What the camera saw of the room, from anywhere in it. Stage space, metres, linear radiance.
#ifndef FOVERAY_PASSTHROUGH_ROOM_GLSL
#define FOVERAY_PASSTHROUGH_ROOM_GLSL

#include "shaders/shared/room.h"
#include "shaders/engine/textures.glsl"

// OpenCV's lens models (calib3d, "Camera Calibration and 3D Reconstruction" and its namespace fisheye), from the
// undistorted to the distorted position on the plane at distance 1, y down. Fisheye: the undistorted position is
// the angle to the axis, along the direction's azimuth.
vec2 camera_distort(RoomParamsRef room, vec2 p) {
    float r2 = dot(p, p);
    float k0 = room.value.distortion[0], k1 = room.value.distortion[1];
    float k2 = room.value.distortion[2], k3 = room.value.distortion[3];
    if (room.value.model == CAMERA_FISHEYE) return p * (1.0 + r2 * (k0 + r2 * (k1 + r2 * (k2 + r2 * k3))));
    float k4 = room.value.distortion[4], k5 = room.value.distortion[5];
    float k6 = room.value.distortion[6], k7 = room.value.distortion[7];
    float radial = (1.0 + r2 * (k0 + r2 * (k1 + r2 * k4))) / (1.0 + r2 * (k5 + r2 * (k6 + r2 * k7)));
    return p * radial + vec2(2.0 * k2 * p.x * p.y + k3 * (r2 + 2.0 * p.x * p.x),
                             k2 * (r2 + 2.0 * p.y * p.y) + 2.0 * k3 * p.x * p.y);
}

// Where the newest picture shows a point; (0, 0) is its top left corner, (1, 1) the bottom right one. False when it
// does not.
bool camera_uv(RoomParamsRef room, vec3 point, out vec2 uv) {
    uv = vec2(0.0);
    if (room.value.picture == NO_PICTURE) return false;
    vec3 p = (room.value.camera_from_stage * vec4(point, 1.0)).xyz;
    vec2 side = vec2(p.x, -p.y);
    float off_axis = length(side);
    float angle = atan(off_axis, -p.z);
    if (angle > room.value.max_angle) return false;
    vec2 undistorted =
        room.value.model == CAMERA_FISHEYE ? (off_axis > 0.0 ? side * (angle / off_axis) : vec2(0.0)) : side / -p.z;
    uv = (camera_distort(room, undistorted) * room.value.focal + room.value.principal) / room.value.picture_size;
    return all(greaterThanEqual(uv, vec2(0.0))) && all(lessThanEqual(uv, vec2(1.0)));
}

// Where a ray enters a real surface's box, or leaves it when it starts inside; negative when it does neither.
float proxy_distance(RoomProxy proxy, vec3 origin, vec3 direction) {
    vec3 halves[3] = vec3[3](proxy.half_x, proxy.half_y, proxy.half_z);
    float first = -1e30, last = 1e30;
    for (int i = 0; i < 3; ++i) {
        float extent = length(halves[i]);
        // A plane has no third axis of its own: it is what is perpendicular to the other two.
        vec3 axis = extent > 0.0 ? halves[i] / extent : normalize(cross(halves[(i + 1) % 3], halves[(i + 2) % 3]));
        float along = dot(axis, direction);
        along = abs(along) < 1e-9 ? 1e-9 : along;
        float from_center = dot(axis, proxy.center - origin);
        float a = (from_center - extent) / along, b = (from_center + extent) / along;
        first = max(first, min(a, b));
        last = min(last, max(a, b));
    }
    if (first > last) return -1.0;
    return first > 0.0 ? first : last;
}

// How far the room is along a ray (unit length) as far as its proxies tell.
float room_distance(RoomParamsRef room, vec3 origin, vec3 direction) {
    float nearest = room.value.far_distance;
    for (uint i = 0; i < room.value.proxy_count; ++i) {
        float t = proxy_distance(room.value.proxies[i], origin, direction);
        if (t > 0.0 && t < nearest) nearest = t;
    }
    return nearest;
}

// Light that reaches `origin` from the room against `direction` (unit length). False where the camera did not see:
// then the environment stands in.
bool room_radiance(RoomParamsRef room, vec3 origin, vec3 direction, out vec3 radiance) {
    radiance = vec3(0.0);
    vec2 uv;
    if (!camera_uv(room, origin + room_distance(room, origin, direction) * direction, uv)) return false;
    radiance = room.value.exposure * textureLod(textures[room.value.picture], uv, 0.0).rgb;
    return true;
}

#endif
