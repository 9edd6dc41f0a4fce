#include "xr/simulator/script/gaze_tracker.h"

#include <algorithm>
#include <cmath>

#include "xr/simulator/script/noise.h"

namespace foveray::simulator {
namespace {

constexpr Nanoseconds sample_period = 5 * nanoseconds_per_millisecond;
constexpr std::uint64_t noise_channel = 1, blink_channel = 7;

/// Rounded down, also below 0.
Nanoseconds floor_to(Nanoseconds time, Nanoseconds step) { return time - ((time % step) + step) % step; }

}  // namespace

std::optional<Nanoseconds> GazeTracker::blink_at(Nanoseconds time) const {
    if (options_.blinks <= 0.0 || time < 0) return std::nullopt;
    // One in each slot of time, with room at its end so that two never touch.
    const Nanoseconds slot = from_seconds(60.0 / options_.blinks);
    const std::int64_t index = time / slot;
    const auto room = static_cast<double>(slot - 2 * options_.blink);
    const Nanoseconds begin =
        index * slot + static_cast<Nanoseconds>(room * uniform(options_.seed, index, blink_channel));
    if (time < begin || time >= begin + options_.blink) return std::nullopt;
    return begin;
}

GazeSample GazeTracker::with_noise(GazeSample sample) const {
    if (options_.noise <= 0.0 || !sample.valid) return sample;
    // Of the error's square, half lies in each direction.
    const float deviation = radians(static_cast<float>(options_.noise)) / std::sqrt(2.0f);
    const vec2 error = deviation * normal_pair(options_.seed, sample.time, noise_channel);
    const vec3 other = std::abs(sample.direction.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
    const vec3 right = glm::normalize(glm::cross(sample.direction, other));
    const vec3 up = glm::cross(right, sample.direction);
    const float angle = glm::length(error);
    if (angle > 0.0f) {
        const vec3 aside = (error.x * right + error.y * up) / angle;
        sample.direction = glm::normalize(std::cos(angle) * sample.direction + std::sin(angle) * aside);
    }
    return sample;
}

GazeSample GazeTracker::measured(const Session& session, Nanoseconds time) const {
    if (!session.gaze.empty()) return with_noise(session.gaze_at(time));
    GazeSample sample;
    sample.valid = true;
    const bool samples = pattern_ || options_ != GazeOptions{};
    sample.time = samples ? floor_to(time, sample_period) : time;
    if (pattern_) sample.direction = pattern_->gaze_direction(sample.time);
    return with_noise(sample);
}

GazeSample GazeTracker::at(const Session& session, Nanoseconds time) const {
    GazeSample sample = measured(session, time - options_.latency);
    if (blink_at(sample.time)) sample.valid = false;
    return sample;
}

std::optional<GazeSample> GazeTracker::last_valid_at(const Session& session, Nanoseconds time) const {
    time -= options_.latency;
    if (session.gaze.empty()) {
        GazeSample sample = measured(session, time);
        while (const auto blink = blink_at(sample.time)) {
            if (*blink <= 0) return std::nullopt;
            sample = measured(session, *blink - 1);
        }
        return sample;
    }
    const auto end = std::ranges::upper_bound(session.gaze, time, {}, &GazeSample::time);
    const auto found =
        std::find_if(std::make_reverse_iterator(end), session.gaze.rend(),
                     [&](const GazeSample& sample) { return sample.valid && !blink_at(sample.time); });
    if (found == session.gaze.rend()) return std::nullopt;
    return with_noise(*found);
}

}  // namespace foveray::simulator
