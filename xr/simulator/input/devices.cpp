#include "xr/simulator/input/devices.h"

#include <cmath>

namespace foveray::simulator {
namespace {

/// The rotation with the least roll that turns -z to `direction`.
quat look_along(vec3 direction) {
    const vec3 up = std::abs(direction.y) > 0.999f ? vec3(0.0f, 0.0f, 1.0f) : vec3(0.0f, 1.0f, 0.0f);
    return glm::quatLookAt(direction, up);
}

Placement place_gaze(const GazeSample& gaze, const FrameClock& clock) {
    if (!gaze.valid) return {Placement::Carrier::Head, {}, 0, 0};
    return {Placement::Carrier::Head,
            {look_along(gaze.direction), gaze.origin},
            all_location_flags,
            clock.time_of(gaze.time)};
}

/// A stick's x and y are the components of the stick: its path and the component's index.
struct ComponentOf {
    std::string_view parent;
    int index;
};
std::optional<ComponentOf> component_of(const InputSource& source) {
    const std::string_view path = source.path;
    if (!path.ends_with("/x") && !path.ends_with("/y")) return std::nullopt;
    return ComponentOf{path.substr(0, path.size() - 2), path.back() == 'x' ? 0 : 1};
}

}  // namespace

bool Devices::automates(std::string_view user_path) const { return automated_ && user_path != eyes_path; }

std::optional<Devices::Device> Devices::connected(std::string_view user_path) const {
    if (user_path == eyes_path) {
        if (!instance_.profile().eye_tracking) return std::nullopt;
        return Device{};
    }
    const std::lock_guard lock(mutex_);
    if (automated_) {
        const auto found = devices_.find(user_path);
        if (found == devices_.end() || !found->second.active) return std::nullopt;
        return Device{found->second.profile};
    }
    const auto hand = hand_of(user_path);
    if (!hand || !instance_.script().has_controller(*hand)) return std::nullopt;
    return Device{};
}

std::optional<vec2> Devices::value(const InputSource& source, Nanoseconds session_time) const {
    if (!connected(source.user)) return std::nullopt;
    const std::lock_guard lock(mutex_);
    if (automates(source.user)) {
        const auto component = component_of(source);
        const auto found = values_.find(component ? component->parent : std::string_view(source.path));
        if (found == values_.end()) return vec2(0.0f);
        return component ? vec2(found->second[component->index], 0.0f) : found->second;
    }
    const auto hand = hand_of(source.user);
    if (!hand) return vec2(0.0f);
    const ControllerState state = instance_.script().controller_at(*hand, session_time);
    if (!state.valid) return std::nullopt;
    return input_value(source, state);
}

Placement Devices::place(const InputSource& source, XrTime time) const {
    const FrameClock& clock = instance_.clock();
    const Script& script = instance_.script();
    const Nanoseconds session_time = clock.session_time(time);
    const auto hand = hand_of(source.user);
    if (!connected(source.user)) return {};
    {
        const std::lock_guard lock(mutex_);
        const auto found = placements_.find(source.path);
        if (found != placements_.end()) return found->second;
        if (hand && automated_)
            return {Placement::Carrier::Stage, resting_hand(*hand), all_location_flags, 0};
    }
    if (!hand) return place_gaze(script.gaze_at(session_time), clock);
    const ControllerState state = script.controller_at(*hand, session_time);
    const bool aim = source.component == "/input/aim/pose";
    return {Placement::Carrier::Stage, aim ? state.stage_from_aim : state.stage_from_grip,
            state.valid ? all_location_flags : 0, 0};
}

Placement Devices::place_rendering_gaze(XrTime time) const {
    const FrameClock& clock = instance_.clock();
    const auto gaze = instance_.script().rendering_gaze_at(clock.session_time(time));
    return place_gaze(gaze.value_or(GazeSample{}), clock);
}

void Devices::set_active(const std::string& user_path, const InteractionProfile& profile, bool active) {
    const std::lock_guard lock(mutex_);
    automated_ = true;
    devices_[user_path] = {&profile, active};
}

void Devices::set_value(const InputSource& source, vec2 value) {
    const std::lock_guard lock(mutex_);
    automated_ = true;
    if (const auto component = component_of(source)) {
        values_[std::string(component->parent)][component->index] = value.x;
    } else {
        values_[source.path] = value;
    }
}

void Devices::set_placement(const InputSource& source, const Placement& placement) {
    const std::lock_guard lock(mutex_);
    automated_ = true;
    placements_[source.path] = placement;
}

}  // namespace foveray::simulator
