#pragma once

#include "base/math.h"
#include "base/time.h"

namespace foveray {

/// The combined gaze of both eyes as a tracker reports it.
struct GazeSample {
    Nanoseconds time = 0;               // when the tracker measured it, not when it was asked
    bool valid = false;                 // false during a blink or without eye tracking
    vec3 origin{0.0f};                  // metres, in the frame that the holder names
    vec3 direction{0.0f, 0.0f, -1.0f};  // unit length
};

}  // namespace foveray
