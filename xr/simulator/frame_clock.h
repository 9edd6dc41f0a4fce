#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>

#include "base/time.h"
#include "xr/simulator/options.h"

namespace foveray::simulator {

struct FrameTime {
    std::uint64_t index = 0;  // of the frame in the session
    Nanoseconds display_time = 0;
    Nanoseconds period = 0;  // until the next frame that a client that keeps pace may show
};

/// When frames are shown. In virtual time each frame comes one period after the last, however long the client
/// takes; in stepped time likewise, once it is asked for; in real time frames follow the machine's monotonic
/// clock, and a slow client misses some.
/// Frame i is shown at the time of frame 0 plus i periods, where the session's time is i periods.
class FrameClock {
  public:
    FrameClock(TimeMode mode, double rate_hz);

    /// Where a clock stands.
    struct Position {
        bool started = false;
        Nanoseconds first_display_time = 0, last_display_time = 0;
        std::uint64_t next_index = 0;
    };
    Position position() const;
    /// Goes on where another one stopped. Before any frame.
    void go_on(const Position& position);

    TimeMode mode() const { return mode_; }
    Nanoseconds period() const { return period_; }
    /// The time that a client would read off a clock now.
    Nanoseconds now() const;
    /// Waits until the next frame may begin; in stepped time, if not `no_wait`, until it is asked for. A
    /// compositor that takes longer than a period for a frame skips some. One caller at a time.
    FrameTime next_frame(Nanoseconds compositor_frame, const std::stop_token& no_wait);
    /// For sessions without frames, at once: the frame that is due; in virtual time the next one, in stepped
    /// time the next one that was asked for. One caller at a time.
    FrameTime tick();
    /// Stepped time: lets so many frames more begin.
    void step(std::uint64_t frames);
    /// Those that did not begin are not asked for any more.
    void drop_steps();
    /// All frames that were asked for were handed in, or dropped for later ones.
    bool steps_done() const;

    /// The client handed that frame in; in real time it is shown with the next display period.
    void end_frame(const FrameTime& frame);
    /// No frame is expected before the next one.
    void pause();
    /// Real time: display periods that showed no new frame though the compositor kept pace.
    std::uint64_t missed_frames() const { return missed_frames_; }

    /// Time since frame 0 was shown; 0 before that.
    Nanoseconds session_time(Nanoseconds time) const;
    Nanoseconds time_of(Nanoseconds session_time) const { return first_display_time_ + session_time; }

  private:
    FrameTime frame(std::uint64_t index, std::uint64_t periods = 1);
    bool take_step();

    TimeMode mode_;
    Nanoseconds period_;
    std::atomic<Nanoseconds> first_display_time_, last_display_time_;
    std::atomic<bool> started_ = false;
    std::atomic<std::uint64_t> next_index_ = 0, missed_frames_ = 0;

    mutable std::mutex mutex_;  // what follows
    std::condition_variable_any stepped_;
    std::uint64_t steps_ = 0;
    std::uint64_t ended_index_ = 0;  // first frame that was not handed in
    std::optional<std::uint64_t> last_shown_;
};

/// One over the rate, rounded up to a nanosecond, so that a sample stamped i / rate is never later than frame
/// i.
Nanoseconds frame_period(double rate_hz);
/// Real time: the frame that may begin `elapsed` after frame 0 could: a whole period lies before its display
/// time, or nearly so. At least `next_index`.
std::uint64_t due_frame(Nanoseconds elapsed, Nanoseconds period, std::uint64_t next_index);

}  // namespace foveray::simulator
