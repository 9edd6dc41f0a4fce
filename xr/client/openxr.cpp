#include "xr/client/openxr.h"

#include <openxr/openxr_reflection.h>

#include "base/error.h"

namespace foveray::xr {

std::string result_name(XrResult result) {
    switch (result) {
#define FOVERAY_CASE(name, value) \
    case name:                    \
        return #name;
        XR_LIST_ENUM_XrResult(FOVERAY_CASE)
#undef FOVERAY_CASE
                default : return "XrResult " +
                          std::to_string(result);
    }
}

XrResult check(XrResult result, const char* call) {
    if (result == XR_ERROR_SESSION_LOST || result == XR_ERROR_INSTANCE_LOST) {
        throw_missing("OpenXR runtime", std::string("it lost the headset in ") + call,
                      "see that runtime and headset are running, and start foveray again");
    }
    if (XR_FAILED(result)) {
        throw_missing("OpenXR runtime", std::string(call) + " failed with " + result_name(result),
                      "`foveray doctor` shows the runtime; --runtime simulator needs none");
    }
    return result;
}

Pose to_pose(const XrPosef& pose) {
    const auto& [q, p] = pose;
    return {quat(q.w, q.x, q.y, q.z), vec3(p.x, p.y, p.z)};
}

XrPosef to_xr(const Pose& pose) {
    const auto& [q, p] = pose;
    return {{q.x, q.y, q.z, q.w}, {p.x, p.y, p.z}};
}

Fov to_fov(const XrFovf& fov) { return {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown}; }

XrFovf to_xr(const Fov& fov) { return {fov.left, fov.right, fov.up, fov.down}; }

const char* state_name(XrSessionState state) {
    switch (state) {
#define FOVERAY_CASE(name, value) \
    case name:                    \
        return #name;
        XR_LIST_ENUM_XrSessionState(FOVERAY_CASE)
#undef FOVERAY_CASE
            default : return "an unknown state";
    }
}

}  // namespace foveray::xr
