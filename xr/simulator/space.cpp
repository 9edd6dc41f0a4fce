#include "xr/simulator/space.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "xr/simulator/session.h"

namespace foveray::simulator {
namespace {

/// Both as seen from the stage, where the carriers differ.
Placement on_stage(const Placement& placement, const Script::Head& head) {
    if (placement.carrier == Placement::Carrier::Stage) return placement;
    return {Placement::Carrier::Stage, head.stage_from_head * placement.carrier_from_space,
            placement.flags & head.flags, placement.sample_time};
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
                return {Carrier::Head, {}, all_location_flags, 0};
            case XR_REFERENCE_SPACE_TYPE_LOCAL:
                return {Carrier::Stage, script.stage_from_local_at(clock.session_time(time)),
                        all_location_flags, 0};
            case XR_REFERENCE_SPACE_TYPE_COMBINED_EYE_VARJO:
                return session_->devices().place_rendering_gaze(time);
            default:
                return {Carrier::Stage,
                        *reference == XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR
                            ? script.stage_from_local_floor_at(clock.session_time(time))
                            : Pose{},
                        all_location_flags, 0};
        }
    }
    const auto& action = std::get<ActionSource>(origin_);
    const InputSource* source = session_->inputs().state(*action.action, action.subaction_path).source;
    return source ? session_->devices().place(*source, time) : Placement{};
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

SpaceLocation locate_stage(const Space& base, XrTime time) {
    Instance& instance = base.session().instance();
    const Placement b =
        on_stage(base.place(time), instance.script().head_at(instance.clock().session_time(time)));
    return {inverse(b.carrier_from_space), b.flags, 0};
}

XrSpaceVelocityFlags velocity_flags(const Velocity& velocity) {
    return velocity.valid ? XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT : 0;
}

TimeSpan span_round(XrTime time) {
    constexpr Nanoseconds step = 5 * nanoseconds_per_millisecond;
    return {std::max<XrTime>(time - step, 1),
            std::min(time, std::numeric_limits<XrTime>::max() - step) + step};
}

Velocity velocity_between(const Pose& before, const Pose& after, TimeSpan span) {
    const auto seconds = static_cast<float>(to_seconds(span.end - span.begin));
    quat turn = after.orientation * glm::conjugate(before.orientation);
    if (turn.w < 0.0f) turn = -turn;
    const vec3 axis(turn.x, turn.y, turn.z);
    const float sine = glm::length(axis);
    Velocity result;
    result.valid = true;
    result.linear = (after.position - before.position) / seconds;
    if (sine > 1e-7f) result.angular = axis / sine * (2.0f * std::atan2(sine, turn.w) / seconds);
    return result;
}

Velocity velocity(const Space& space, const Space& base, XrTime time) {
    const TimeSpan span = span_round(time);
    const SpaceLocation before = locate(space, base, span.begin), after = locate(space, base, span.end);
    if (!(before.flags & after.flags)) return {};
    return velocity_between(before.base_from_space, after.base_from_space, span);
}

HeadLocation locate_head(const Space& base, XrTime time) {
    Instance& instance = base.session().instance();
    const Script::Head head = instance.script().head_at(instance.clock().session_time(time));
    const Placement b = base.place(time);
    if (b.carrier == Placement::Carrier::Head) return {inverse(b.carrier_from_space), b.flags};
    return {inverse(b.carrier_from_space) * head.stage_from_head, b.flags & head.flags};
}

}  // namespace foveray::simulator
