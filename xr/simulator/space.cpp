#include "xr/simulator/space.h"

#include <algorithm>
#include <cmath>

#include "xr/simulator/input_sources.h"
#include "xr/simulator/session.h"

namespace foveray::simulator {
namespace {

constexpr XrSpaceLocationFlags valid_flags =
    XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
constexpr XrSpaceLocationFlags all_flags =
    valid_flags | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;

/// The rotation with the least roll that turns -z to `direction`.
quat look_along(vec3 direction) {
    const vec3 up = std::abs(direction.y) > 0.999f ? vec3(0.0f, 0.0f, 1.0f) : vec3(0.0f, 1.0f, 0.0f);
    return glm::quatLookAt(direction, up);
}

Placement place_gaze(const GazeSample& gaze, const FrameClock& clock) {
    if (!gaze.valid) return {Placement::Carrier::Head, {}, 0, 0};
    return {Placement::Carrier::Head,
            {look_along(gaze.direction), gaze.origin},
            all_flags,
            clock.time_of(gaze.time)};
}

/// Both as seen from the stage, where the carriers differ.
Placement on_stage(const Placement& placement, const Script::Head& head) {
    if (placement.carrier == Placement::Carrier::Stage) return placement;
    return {Placement::Carrier::Stage, head.stage_from_head * placement.carrier_from_space,
            head.tracked ? placement.flags : 0, placement.sample_time};
}

}  // namespace

Placement Space::place_origin(XrTime time) const {
    Instance& instance = session_->instance();
    const FrameClock& clock = instance.clock();
    const Script& script = instance.script();
    using Carrier = Placement::Carrier;
    if (const auto* reference = std::get_if<XrReferenceSpaceType>(&origin_)) {
        switch (*reference) {
            case XR_REFERENCE_SPACE_TYPE_VIEW:
                return {Carrier::Head, {}, all_flags, 0};
            case XR_REFERENCE_SPACE_TYPE_LOCAL:
                return {Carrier::Stage, script.stage_from_local_at(clock.session_time(time)), all_flags, 0};
            case XR_REFERENCE_SPACE_TYPE_COMBINED_EYE_VARJO:
                return place_gaze(script.rendering_gaze_at(clock.session_time(time)).value_or(GazeSample{}),
                                  clock);
            default:
                return {Carrier::Stage, {}, all_flags, 0};
        }
    }
    const auto& action = std::get<ActionSource>(origin_);
    const InputSource* source = session_->inputs().state(*action.action, action.subaction_path).source;
    if (!source) return {};
    const auto hand = hand_of(source->user);
    if (!hand) return place_gaze(script.gaze_at(clock.session_time(time)), clock);
    const ControllerState state = script.controller_at(*hand, clock.session_time(time));
    const bool aim = source->component == "/input/aim/pose";
    return {Carrier::Stage, aim ? state.stage_from_aim : state.stage_from_grip, state.valid ? all_flags : 0,
            0};
}

Placement Space::place(XrTime time) const {
    Placement placement = place_origin(time);
    placement.carrier_from_space = placement.carrier_from_space * origin_from_space_;
    return placement;
}

SpaceLocation locate(const Space& space, const Space& base, XrTime time) {
    Placement a = space.place(time), b = base.place(time);
    if (a.carrier != b.carrier) {
        Instance& instance = space.session().instance();
        const Script::Head head = instance.script().head_at(instance.clock().session_time(time));
        a = on_stage(a, head);
        b = on_stage(b, head);
    }
    SpaceLocation location;
    location.flags = a.flags & b.flags;
    if (!location.flags) return location;
    location.base_from_space = inverse(b.carrier_from_space) * a.carrier_from_space;
    location.sample_time = a.sample_time;
    return location;
}

Velocity velocity(const Space& space, const Space& base, XrTime time) {
    constexpr Nanoseconds step = 5 * nanoseconds_per_millisecond;
    const Nanoseconds before_time = std::max<XrTime>(time - step, 1);
    const SpaceLocation before = locate(space, base, before_time), after = locate(space, base, time + step);
    if (!(before.flags & after.flags)) return {};
    const auto seconds = static_cast<float>(to_seconds(time + step - before_time));
    quat turn = after.base_from_space.orientation * glm::conjugate(before.base_from_space.orientation);
    if (turn.w < 0.0f) turn = -turn;
    const vec3 axis(turn.x, turn.y, turn.z);
    const float sine = glm::length(axis);
    Velocity result;
    result.valid = true;
    result.linear = (after.base_from_space.position - before.base_from_space.position) / seconds;
    if (sine > 1e-7f) result.angular = axis / sine * (2.0f * std::atan2(sine, turn.w) / seconds);
    return result;
}

HeadLocation locate_head(const Space& base, XrTime time) {
    Instance& instance = base.session().instance();
    const Script::Head head = instance.script().head_at(instance.clock().session_time(time));
    const Placement b = base.place(time);
    if (b.carrier == Placement::Carrier::Head) return {inverse(b.carrier_from_space), b.flags};
    return {inverse(b.carrier_from_space) * head.stage_from_head, head.tracked ? b.flags : 0};
}

}  // namespace foveray::simulator
