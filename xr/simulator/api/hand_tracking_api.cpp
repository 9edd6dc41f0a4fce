#include "xr/simulator/api/functions.h"
#include "xr/simulator/convert.h"
#include "xr/simulator/input/hand_tracker.h"
#include "xr/simulator/space.h"

namespace foveray::simulator {
namespace {

/// The joints as seen from `base` with the flags of that place; nothing where the hand is not seen.
struct SeenHand {
    HandJoints base_from_joint;
    XrSpaceLocationFlags flags;
};

std::optional<SeenHand> see(const HandTracker& tracker, const Space& base, XrTime time) {
    Instance& instance = tracker.session().instance();
    auto joints = instance.script().hand_at(tracker.hand(), instance.clock().session_time(time));
    if (!joints) return std::nullopt;
    const SpaceLocation stage = locate_stage(base, time);
    if (!stage.flags) return std::nullopt;
    for (HandJoint& joint : *joints) joint.stage_from_joint = stage.base_from_space * joint.stage_from_joint;
    return SeenHand{*joints, stage.flags};
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL xrCreateHandTrackerEXT(XrSession session,
                                                      const XrHandTrackerCreateInfoEXT* info,
                                                      XrHandTrackerEXT* tracker) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT);
        verify(tracker != nullptr);
        verify(info->hand == XR_HAND_LEFT_EXT || info->hand == XR_HAND_RIGHT_EXT);
        verify(info->handJointSet == XR_HAND_JOINT_SET_DEFAULT_EXT);
        *tracker = add_object(std::make_shared<HandTracker>(object, info->hand == XR_HAND_LEFT_EXT ? 0 : 1),
                              object->id());
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrDestroyHandTrackerEXT(XrHandTrackerEXT tracker) {
    return guarded([&] { destroy<HandTracker>(tracker); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrLocateHandJointsEXT(XrHandTrackerEXT tracker,
                                                     const XrHandJointsLocateInfoEXT* info,
                                                     XrHandJointLocationsEXT* locations) {
    return guarded([&] {
        const auto object = get<HandTracker>(tracker);
        verify_structure(info, XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT);
        verify_structure(locations, XR_TYPE_HAND_JOINT_LOCATIONS_EXT);
        verify(locations->jointCount == XR_HAND_JOINT_COUNT_EXT && locations->jointLocations != nullptr);
        auto* velocities =
            find_output<XrHandJointVelocitiesEXT>(locations->next, XR_TYPE_HAND_JOINT_VELOCITIES_EXT);
        verify(!velocities ||
               (velocities->jointCount == XR_HAND_JOINT_COUNT_EXT && velocities->jointVelocities != nullptr));
        const auto base = get<Space>(info->baseSpace);
        verify(&base->session() == &object->session());
        verify(info->time > 0, XR_ERROR_TIME_INVALID);

        const auto hand =
            object->session().focused() ? see(*object, *base, info->time) : std::optional<SeenHand>();
        locations->isActive = hand.has_value();
        for (std::size_t i = 0; i < XR_HAND_JOINT_COUNT_EXT; ++i) {
            const HandJoint joint = hand ? hand->base_from_joint[i] : HandJoint{};
            locations->jointLocations[i] = {hand ? hand->flags : 0, to_xr(joint.stage_from_joint),
                                            joint.radius};
        }
        if (!velocities) return;
        const TimeSpan span = span_round(info->time);
        const auto before = hand ? see(*object, *base, span.begin) : std::nullopt,
                   after = hand ? see(*object, *base, span.end) : std::nullopt;
        for (std::size_t i = 0; i < XR_HAND_JOINT_COUNT_EXT; ++i) {
            const Velocity moving = before && after
                                        ? velocity_between(before->base_from_joint[i].stage_from_joint,
                                                           after->base_from_joint[i].stage_from_joint, span)
                                        : Velocity{};
            velocities->jointVelocities[i] = {velocity_flags(moving), to_xr(moving.linear),
                                              to_xr(moving.angular)};
        }
    });
}

}  // namespace foveray::simulator
