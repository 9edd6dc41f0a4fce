#pragma once

#include <deque>

#include "base/math.h"
#include "base/time.h"

namespace foveray::app {

/// Where the head was: camera pictures are older than the frames that show them.
class HeadHistory {
  public:
    /// Times must not go backwards.
    void add(Nanoseconds time, const Pose& stage_from_head);
    /// Interpolated; the nearest known pose outside the last second. The identity before the first.
    Pose at(Nanoseconds time) const;

  private:
    struct Sample {
        Nanoseconds time;
        Pose stage_from_head;
    };
    std::deque<Sample> samples_;
};

}  // namespace foveray::app
