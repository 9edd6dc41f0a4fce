#pragma once

#include <memory>
#include <utility>

#include <openxr/openxr.h>

#include "xr/simulator/handles.h"
#include "xr/simulator/session.h"

namespace foveray::simulator {

/// XR_EXT_hand_tracking: one hand of a session.
class HandTracker : public Object {
  public:
    using Handle = XrHandTrackerEXT;
    static constexpr XrObjectType object_type = XR_OBJECT_TYPE_HAND_TRACKER_EXT;

    /// hand: 0 left, 1 right.
    HandTracker(std::shared_ptr<Session> session, int hand) : session_(std::move(session)), hand_(hand) {}

    const Session& session() const { return *session_; }
    int hand() const { return hand_; }

  private:
    std::shared_ptr<Session> session_;
    int hand_;
};

}  // namespace foveray::simulator
