#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include <openxr/openxr.h>

#include "base/frame.h"
#include "base/time.h"

namespace foveray::simulator {

struct HandJoint {
    Pose stage_from_joint;  // axes of XR_EXT_hand_tracking: -z towards the tip, y out of the hand's back
    float radius = 0.0f;    // metres
};
using HandJoints = std::array<HandJoint, XR_HAND_JOINT_COUNT_EXT>;  // by XrHandJointEXT

/// A hand round a controller: `squeeze` and `trigger` bend the fingers. hand: 0 left, 1 right.
HandJoints hand_round_controller(int hand, const ControllerState& controller);

/// The stream hands.csv of a session folder, which docs/session-format.md describes.
class HandStream {
  public:
    HandStream() = default;
    /// Without the file there are no samples. Throws Fault(BadInput) naming file, line and remedy.
    explicit HandStream(const std::filesystem::path& session_folder);

    bool empty() const { return samples_[0].empty() && samples_[1].empty(); }
    /// The newest sample at or before `time`; nullptr when there is none or the hand was not tracked.
    const HandJoints* at(int hand, Nanoseconds time) const;

  private:
    struct Sample {
        Nanoseconds time = 0;
        bool valid = false;
        HandJoints joints;
    };
    std::array<std::vector<Sample>, 2> samples_;
};

}  // namespace foveray::simulator
