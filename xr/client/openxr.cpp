#include "xr/client/openxr.h"

#include <openxr/openxr_reflection.h>

namespace foveray::xr {
namespace {

const char* remedy_for(XrResult result) {
    switch (result) {
        case XR_ERROR_OUT_OF_MEMORY:
            return "end other programs, or show a smaller scene";
        case XR_ERROR_RUNTIME_FAILURE:
        case XR_ERROR_RUNTIME_UNAVAILABLE:
            return "start the runtime anew, then foveray; its own log may tell why";
        default:
            return "`foveray doctor` shows the runtime; --runtime simulator needs none";
    }
}

}  // namespace

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

Lost::Lost(What what_was_lost, std::string event)
    : Fault(ExitCode::Missing, "OpenXR runtime", "it " + event,
            "see that runtime and headset are running, and start foveray again"),
      lost_(what_was_lost),
      event_(std::move(event)) {}

XrResult check(XrResult result, const char* call) {
    if (XR_SUCCEEDED(result)) return result;
    if (result == XR_ERROR_SESSION_LOST)
        throw Lost(Lost::What::Session, std::string("lost the headset's session in ") + call);
    if (result == XR_ERROR_INSTANCE_LOST)
        throw Lost(Lost::What::Instance, std::string("lost the headset's instance in ") + call);
    throw_missing("OpenXR runtime", std::string(call) + " failed with " + result_name(result),
                  remedy_for(result));
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
