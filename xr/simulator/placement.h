#pragma once

#include <openxr/openxr.h>

#include "base/math.h"

namespace foveray::simulator {

/// Where something is at a time, relative to what carries it.
struct Placement {
    enum class Carrier { Stage, Head } carrier = Carrier::Stage;
    Pose carrier_from_space;
    XrSpaceLocationFlags flags = 0;
    XrTime sample_time = 0;  // of gaze: when the tracker measured it; 0 when invalid
};

inline constexpr XrSpaceLocationFlags all_location_flags =
    XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT |
    XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;

/// The stage's pose of a hand (0 left, 1 right) that nobody placed: before the chest.
inline Pose resting_hand(int hand) {
    return {quat(1.0f, 0.0f, 0.0f, 0.0f), vec3(hand == 0 ? -0.2f : 0.2f, 1.2f, -0.4f)};
}

}  // namespace foveray::simulator
