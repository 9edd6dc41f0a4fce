#pragma once

#include <cstdint>
#include <string_view>

#include "base/math.h"
#include "base/time.h"

namespace foveray::simulator {

/// A generated wearer: head and gaze as functions of session time and a seed.
class Pattern {
  public:
    enum class Kind {
        Static,   // looks straight ahead
        Sweep,    // the head turns smoothly from side to side, and up and down, the eyes with it
        Saccades  // the eyes jump from target to target, the head follows more slowly
    };

    Pattern(Kind kind, std::uint64_t seed) : kind_(kind), seed_(seed) {}

    Pose stage_from_head(Nanoseconds time) const;
    /// Of unit length, in the head's frame.
    vec3 gaze_direction(Nanoseconds time) const;

  private:
    Kind kind_;
    std::uint64_t seed_;
};

/// Seconds that the eyes take for a jump of so many degrees: the main sequence, 2.2 ms a degree and 21 ms
/// (Carpenter, Movements of the Eyes, 1988).
double saccade_duration(double degrees);

}  // namespace foveray::simulator
