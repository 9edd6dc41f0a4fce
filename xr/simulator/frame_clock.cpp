#include "xr/simulator/frame_clock.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace foveray::simulator {
namespace {

constexpr Nanoseconds virtual_start = nanoseconds_per_second;

Nanoseconds monotonic_now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace

std::uint64_t due_frame(Nanoseconds elapsed, Nanoseconds period, std::uint64_t next_index) {
    return std::max(next_index, static_cast<std::uint64_t>(std::max<Nanoseconds>(elapsed, 0) / period));
}

FrameClock::FrameClock(TimeMode mode, double rate_hz)
    : mode_(mode),
      period_(static_cast<Nanoseconds>(std::ceil(1e9 / rate_hz))),
      first_display_time_(mode == TimeMode::Virtual ? virtual_start : monotonic_now()),
      last_display_time_(first_display_time_.load()) {}

Nanoseconds FrameClock::now() const {
    return mode_ == TimeMode::Virtual ? last_display_time_.load() : monotonic_now();
}

FrameTime FrameClock::next_frame() {
    if (mode_ == TimeMode::Virtual) return frame(next_index_);
    if (!started_) first_display_time_ = monotonic_now() + period_;
    const Nanoseconds start = first_display_time_ - period_;
    const std::uint64_t index = due_frame(monotonic_now() - start, period_, next_index_);
    const Nanoseconds wake = start + static_cast<Nanoseconds>(index) * period_;
    std::this_thread::sleep_until(std::chrono::steady_clock::time_point(std::chrono::nanoseconds(wake)));
    return frame(index);
}

FrameTime FrameClock::tick() {
    if (mode_ == TimeMode::Virtual) return frame(next_index_);
    if (!started_) first_display_time_ = monotonic_now();
    return frame(due_frame(monotonic_now() - first_display_time_, period_, 0));
}

FrameTime FrameClock::frame(std::uint64_t index) {
    started_ = true;
    next_index_ = index + 1;
    last_display_time_ = first_display_time_ + static_cast<Nanoseconds>(index) * period_;
    return {index, last_display_time_, period_};
}

Nanoseconds FrameClock::session_time(Nanoseconds time) const {
    return started_ ? std::max<Nanoseconds>(time - first_display_time_, 0) : 0;
}

}  // namespace foveray::simulator
