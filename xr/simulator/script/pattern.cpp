#include "xr/simulator/script/pattern.h"

#include <algorithm>
#include <cmath>

#include "xr/simulator/script/noise.h"

namespace foveray::simulator {
namespace {

constexpr vec3 standing(0.0f, 1.6f, 0.0f);  // metres

/// Yaw to the left and pitch upwards, degrees.
using Angles = glm::dvec2;

quat rotation(Angles angles) {
    return glm::angleAxis(radians(static_cast<float>(angles.x)), vec3(0.0f, 1.0f, 0.0f)) *
           glm::angleAxis(radians(static_cast<float>(angles.y)), vec3(1.0f, 0.0f, 0.0f));
}

/// From 0 to 1 without jerks (Flash and Hogan, 1985).
double smooth(double u) {
    u = std::clamp(u, 0.0, 1.0);
    return u * u * u * (10.0 + u * (6.0 * u - 15.0));
}

/// One jump falls into each slot of time.
constexpr double slot_seconds = 0.4, latest_jump = 0.2;
constexpr double head_share = 0.6;  // of a target's angle that the head turns to
constexpr Angles reach(20.0, 12.0);

Angles target(std::uint64_t seed, std::int64_t slot) {
    if (slot < 0) return {0.0, 0.0};
    return reach * (2.0 * Angles(uniform(seed, slot, 0), uniform(seed, slot, 1)) - 1.0);
}

struct Look {
    Angles eyes, head;
};
Look saccades(std::uint64_t seed, double seconds) {
    const auto slot = static_cast<std::int64_t>(seconds / slot_seconds);
    const double in_slot = seconds - static_cast<double>(slot) * slot_seconds;
    const Angles from = target(seed, slot - 1), to = target(seed, slot);
    const double jump = latest_jump * uniform(seed, slot, 2);
    const double duration = saccade_duration(glm::length(to - from));
    return {glm::mix(from, to, smooth((in_slot - jump) / duration)),
            head_share * glm::mix(from, to, smooth(in_slot / slot_seconds))};
}

Angles sweep(std::uint64_t seed, double seconds) {
    constexpr double turn = 2.0 * 3.14159265358979323846;
    const Angles phase = turn * Angles(uniform(seed, 0, 0), uniform(seed, 0, 1));
    return {40.0 * std::sin(turn * seconds / 8.0 + phase.x), 15.0 * std::sin(turn * seconds / 5.0 + phase.y)};
}

double seconds_of(Nanoseconds time) { return to_seconds(std::max<Nanoseconds>(time, 0)); }

}  // namespace

double saccade_duration(double degrees) { return 0.0022 * degrees + 0.021; }

Pose Pattern::stage_from_head(Nanoseconds time) const {
    switch (kind_) {
        case Kind::Static:
            break;
        case Kind::Sweep:
            return {rotation(sweep(seed_, seconds_of(time))), standing};
        case Kind::Saccades:
            return {rotation(saccades(seed_, seconds_of(time)).head), standing};
    }
    return {quat(1.0f, 0.0f, 0.0f, 0.0f), standing};
}

vec3 Pattern::gaze_direction(Nanoseconds time) const {
    const vec3 ahead(0.0f, 0.0f, -1.0f);
    if (kind_ != Kind::Saccades) return ahead;
    const Look look = saccades(seed_, seconds_of(time));
    return glm::normalize(glm::conjugate(rotation(look.head)) * rotation(look.eyes) * ahead);
}

}  // namespace foveray::simulator
