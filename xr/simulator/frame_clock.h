#pragma once

#include <atomic>
#include <cstdint>

#include "base/time.h"
#include "xr/simulator/options.h"

namespace foveray::simulator {

struct FrameTime {
    std::uint64_t index = 0;  // of the frame in the session
    Nanoseconds display_time = 0;
    Nanoseconds period = 0;
};

/// When frames are shown. In virtual time each frame comes one period after the last, however long the client
/// takes; in real time frames follow the machine's monotonic clock, and a slow client misses some.
/// Frame i is shown at the time of frame 0 plus i periods, where the session's time is i periods.
class FrameClock {
  public:
    /// The period is rounded up to a nanosecond, so that a sample stamped i / rate is never later than frame
    /// i.
    FrameClock(TimeMode mode, double rate_hz);

    Nanoseconds period() const { return period_; }
    /// The time that a client would read off a clock now.
    Nanoseconds now() const;
    /// Waits until the next frame may begin. One caller at a time.
    FrameTime next_frame();
    /// For sessions without frames, at once: the frame that is due; in virtual time the next one. One caller
    /// at a time.
    FrameTime tick();

    /// Time since frame 0 was shown; 0 before that.
    Nanoseconds session_time(Nanoseconds time) const;
    Nanoseconds time_of(Nanoseconds session_time) const { return first_display_time_ + session_time; }

  private:
    FrameTime frame(std::uint64_t index);

    TimeMode mode_;
    Nanoseconds period_;
    std::atomic<Nanoseconds> first_display_time_, last_display_time_;
    std::atomic<bool> started_ = false;
    std::atomic<std::uint64_t> next_index_ = 0;
};

/// Real time: the frame that may begin `elapsed` after frame 0 began, at least `next_index`.
std::uint64_t due_frame(Nanoseconds elapsed, Nanoseconds period, std::uint64_t next_index);

}  // namespace foveray::simulator
