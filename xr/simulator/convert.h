#pragma once

#include <cmath>

#include <openxr/openxr.h>

#include "base/math.h"
#include "base/view.h"

namespace foveray::simulator {

inline XrVector3f to_xr(vec3 v) { return {v.x, v.y, v.z}; }

inline XrPosef to_xr(const Pose& pose) {
    const quat& q = pose.orientation;
    return {{q.x, q.y, q.z, q.w}, to_xr(pose.position)};
}

inline XrFovf to_xr(const Fov& fov) { return {fov.left, fov.right, fov.up, fov.down}; }

inline Pose from_xr(const XrPosef& pose) {
    const XrQuaternionf& q = pose.orientation;
    return {glm::normalize(quat(q.w, q.x, q.y, q.z)),
            vec3(pose.position.x, pose.position.y, pose.position.z)};
}

inline Fov from_xr(const XrFovf& fov) { return {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown}; }

/// OpenXR 1.0, section 2.16: finite, and a quaternion of length 1 within 1 percent.
inline bool is_valid(const XrPosef& pose) {
    const XrQuaternionf& q = pose.orientation;
    const XrVector3f& p = pose.position;
    const float length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::abs(length - 1.0f) <= 0.01f;
}

}  // namespace foveray::simulator
