#include "xr/simulator/frame_clock.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <ctime>

namespace foveray::simulator {
namespace {

constexpr Nanoseconds virtual_start = nanoseconds_per_second;

Nanoseconds monotonic_now() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * nanoseconds_per_second + now.tv_nsec;
}

void sleep_until(Nanoseconds time) {
    const timespec until{time / nanoseconds_per_second, time % nanoseconds_per_second};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
}

}  // namespace

Nanoseconds frame_period(double rate_hz) { return static_cast<Nanoseconds>(std::ceil(1e9 / rate_hz)); }

std::uint64_t due_frame(Nanoseconds elapsed, Nanoseconds period, std::uint64_t next_index) {
    const Nanoseconds late = std::max<Nanoseconds>(elapsed - period / 8, 0);
    return std::max(next_index, static_cast<std::uint64_t>((late + period - 1) / period));
}

FrameClock::FrameClock(TimeMode mode, double rate_hz)
    : mode_(mode),
      period_(frame_period(rate_hz)),
      first_display_time_(mode == TimeMode::Real ? monotonic_now() : virtual_start),
      last_display_time_(first_display_time_.load()) {}

FrameClock::Position FrameClock::position() const {
    return {started_, first_display_time_, last_display_time_, next_index_};
}

void FrameClock::go_on(const Position& position) {
    started_ = position.started;
    first_display_time_ = position.first_display_time;
    last_display_time_ = position.last_display_time;
    next_index_ = position.next_index;
}

Nanoseconds FrameClock::now() const {
    return mode_ == TimeMode::Real ? monotonic_now() : last_display_time_.load();
}

FrameTime FrameClock::next_frame(Nanoseconds compositor_frame, const std::stop_token& no_wait) {
    const auto periods =
        static_cast<std::uint64_t>(std::max<Nanoseconds>((compositor_frame + period_ - 1) / period_, 1));
    const std::uint64_t next = started_ ? next_index_ + periods - 1 : 0;
    if (mode_ == TimeMode::Stepped) {
        std::unique_lock lock(mutex_);
        stepped_.wait(lock, no_wait, [&] { return take_step(); });
    }
    if (mode_ != TimeMode::Real) return frame(next, periods);
    if (!started_) first_display_time_ = monotonic_now() + period_;
    const Nanoseconds start = first_display_time_ - period_;
    const std::uint64_t index = due_frame(monotonic_now() - start, period_, next);
    sleep_until(start + static_cast<Nanoseconds>(index) * period_);
    return frame(index, periods);
}

FrameTime FrameClock::tick() {
    if (mode_ == TimeMode::Virtual) return frame(next_index_);
    if (mode_ == TimeMode::Stepped) {
        const std::lock_guard lock(mutex_);
        const bool stands_still = started_ && !take_step();
        const FrameTime now = frame(stands_still ? next_index_ - 1 : next_index_.load());
        ended_index_ = next_index_;
        return now;
    }
    if (!started_) first_display_time_ = monotonic_now();
    return frame(static_cast<std::uint64_t>(std::max<Nanoseconds>(monotonic_now() - first_display_time_, 0) /
                                            period_));
}

FrameTime FrameClock::frame(std::uint64_t index, std::uint64_t periods) {
    started_ = true;
    next_index_ = index + 1;
    last_display_time_ = first_display_time_ + static_cast<Nanoseconds>(index) * period_;
    return {index, last_display_time_, static_cast<Nanoseconds>(periods) * period_};
}

bool FrameClock::take_step() {
    if (steps_ == 0) return false;
    --steps_;
    return true;
}

void FrameClock::step(std::uint64_t frames) {
    const std::lock_guard lock(mutex_);
    steps_ += frames;
    stepped_.notify_all();
}

void FrameClock::drop_steps() {
    const std::lock_guard lock(mutex_);
    steps_ = 0;
}

bool FrameClock::steps_done() const {
    const std::lock_guard lock(mutex_);
    return steps_ == 0 && ended_index_ >= next_index_;
}

void FrameClock::end_frame(const FrameTime& frame) {
    {
        const std::lock_guard lock(mutex_);
        ended_index_ = frame.index + 1;
    }
    if (mode_ != TimeMode::Real) return;
    const Nanoseconds late = std::max<Nanoseconds>(monotonic_now() - first_display_time_, 0);
    const auto shown = std::max(frame.index, static_cast<std::uint64_t>((late + period_ - 1) / period_));
    const std::lock_guard lock(mutex_);
    const std::uint64_t expected =
        last_shown_ ? *last_shown_ + static_cast<std::uint64_t>(frame.period / period_) : shown;
    if (shown > expected) missed_frames_ += shown - expected;
    last_shown_ = std::max(shown, last_shown_.value_or(0));
}

void FrameClock::pause() {
    const std::lock_guard lock(mutex_);
    last_shown_.reset();
}

Nanoseconds FrameClock::session_time(Nanoseconds time) const {
    return started_ ? std::max<Nanoseconds>(time - first_display_time_, 0) : 0;
}

}  // namespace foveray::simulator
