#pragma once

#include <array>

#include "base/frame.h"
#include "xr/client/instance.h"

namespace foveray::xr {

/// Controllers and gaze through OpenXR actions.
class Input {
  public:
    Input() = default;
    /// Attaches its action set to the session; a session takes only one.
    Input(const Instance& instance, XrSession session);

    /// Reads the newest states into frame.controllers and frame.gaze, in the space `stage` at
    /// frame.display_time. Without focus everything is invalid.
    void update(XrSession session, XrSpace stage, Frame& frame) const;

  private:
    XrAction make_action(const char* name, const char* localized, XrActionType type, bool per_hand);
    void suggest(const Instance& instance) const;
    XrActionStateGetInfo query(XrAction action, int hand) const;
    float read_float(XrSession session, XrAction action, int hand) const;
    bool read_button(XrSession session, XrAction action, int hand) const;

    std::array<XrPath, 2> hands_{};
    ActionSetHandle action_set_;
    XrAction grip_ = XR_NULL_HANDLE, aim_ = XR_NULL_HANDLE, trigger_ = XR_NULL_HANDLE,
             squeeze_ = XR_NULL_HANDLE;
    XrAction thumbstick_ = XR_NULL_HANDLE, primary_ = XR_NULL_HANDLE, secondary_ = XR_NULL_HANDLE;
    XrAction gaze_ = XR_NULL_HANDLE;
    std::array<SpaceHandle, 2> grip_space_, aim_space_;
    SpaceHandle gaze_space_;
};

}  // namespace foveray::xr
