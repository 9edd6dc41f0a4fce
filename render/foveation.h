#pragma once

#include "base/frame.h"
#include "base/settings.h"

namespace foveray::render {

/// Where samples gather in a frame.
struct Fovea {
    vec3 origin{0.0f};                  // of the gaze ray, stage space
    vec3 direction{0.0f, 0.0f, -1.0f};  // stage space, unit length
    float radius_degrees = 0.0f;        // of the flat, dense disc; 0: as narrow as the acuity function has it
    bool follows_gaze = false;          // false: held, easing or fixed
};

/// Follows the gaze through blinks and losses. A valid gaze is followed. An invalid one is held in the head's
/// frame for Settings::blink_hold_ms, then eased to the head's forward with a fovea of
/// Settings::fixed_fovea_degrees; a gaze that comes back is eased to faster. Without eye tracking the fovea
/// is fixed from the start. Time comes from the frames alone.
class Foveation {
  public:
    static constexpr Nanoseconds ease_out_time = 200 * nanoseconds_per_millisecond;
    static constexpr Nanoseconds ease_back_time = 80 * nanoseconds_per_millisecond;

    /// Once a frame, in order.
    Fovea update(const Frame& frame, const Settings& settings);

  private:
    bool started_ = false;
    Nanoseconds last_time_ = 0;
    bool gaze_seen_ = false;
    Nanoseconds gaze_time_ = 0;  // display time of the newest frame with a valid gaze
    vec3 gaze_origin_{0.0f}, gaze_direction_{0.0f, 0.0f, -1.0f};  // in the head's frame
    float fixed_ = 1.0f;  // 0: at the gaze, 1: at the fixed centre, before smoothing
};

}  // namespace foveray::render
