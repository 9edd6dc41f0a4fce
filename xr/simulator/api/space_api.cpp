#include <span>
#include <vector>

#include "xr/simulator/api/functions.h"
#include "xr/simulator/convert.h"
#include "xr/simulator/session.h"
#include "xr/simulator/space.h"

namespace foveray::simulator {
namespace {

std::vector<XrReferenceSpaceType> reference_spaces(const Instance& instance) {
    std::vector<XrReferenceSpaceType> types{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL,
                                            XR_REFERENCE_SPACE_TYPE_STAGE};
    if (instance.has(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME)) types.push_back(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR);
    if (instance.has(XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME) && instance.profile().eye_tracking) {
        types.push_back(XR_REFERENCE_SPACE_TYPE_COMBINED_EYE_VARJO);
    }
    return types;
}

/// Of spaces in a list: the location, and where asked for the velocity.
void locate_spaces(XrSession session, const XrSpacesLocateInfo* info, XrSpaceLocations* locations) {
    const auto object = get<Session>(session);
    verify_structure(info, XR_TYPE_SPACES_LOCATE_INFO);
    verify_structure(locations, XR_TYPE_SPACE_LOCATIONS);
    verify(info->spaceCount > 0 && info->spaces != nullptr);
    verify(locations->locationCount == info->spaceCount && locations->locations != nullptr);
    auto* velocities = find_output<XrSpaceVelocities>(locations->next, XR_TYPE_SPACE_VELOCITIES);
    verify(!velocities ||
           (velocities->velocityCount == info->spaceCount && velocities->velocities != nullptr));
    const auto base = get<Space>(info->baseSpace);
    verify(&base->session() == object.get());
    std::vector<std::shared_ptr<Space>> spaces;
    for (const XrSpace space : std::span(info->spaces, info->spaceCount)) {
        spaces.push_back(get<Space>(space));
        verify(&spaces.back()->session() == object.get());
    }
    verify(info->time > 0, XR_ERROR_TIME_INVALID);
    for (std::size_t i = 0; i < spaces.size(); ++i) {
        const SpaceLocation found = locate(*spaces[i], *base, info->time);
        locations->locations[i] = {found.flags, to_xr(found.base_from_space)};
        if (!velocities) continue;
        const Velocity moving = velocity(*spaces[i], *base, info->time);
        velocities->velocities[i] = {velocity_flags(moving), to_xr(moving.linear), to_xr(moving.angular)};
    }
}

void verify_reference_space(const Instance& instance, XrReferenceSpaceType type) {
    const auto types = reference_spaces(instance);
    verify(std::ranges::find(types, type) != types.end(), XR_ERROR_REFERENCE_SPACE_UNSUPPORTED);
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL xrEnumerateReferenceSpaces(XrSession session, std::uint32_t capacity,
                                                          std::uint32_t* count, XrReferenceSpaceType* types) {
    return guarded([&] {
        const auto supported = reference_spaces(get<Session>(session)->instance());
        enumerate_values<XrReferenceSpaceType>(supported, capacity, count, types);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrCreateReferenceSpace(XrSession session,
                                                      const XrReferenceSpaceCreateInfo* info,
                                                      XrSpace* space) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
        verify(space != nullptr);
        verify_reference_space(object->instance(), info->referenceSpaceType);
        verify(is_valid(info->poseInReferenceSpace), XR_ERROR_POSE_INVALID);
        *space = add_object(
            std::make_shared<Space>(object, info->referenceSpaceType, from_xr(info->poseInReferenceSpace)),
            object->id());
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetReferenceSpaceBoundsRect(XrSession session, XrReferenceSpaceType type,
                                                             XrExtent2Df* bounds) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify(bounds != nullptr);
        verify_reference_space(object->instance(), type);
        constexpr float stage_side = 3.0f;  // metres
        const bool has_bounds = type == XR_REFERENCE_SPACE_TYPE_STAGE;
        *bounds = has_bounds ? XrExtent2Df{stage_side, stage_side} : XrExtent2Df{0.0f, 0.0f};
        return has_bounds ? XR_SUCCESS : XR_SPACE_BOUNDS_UNAVAILABLE;
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrCreateActionSpace(XrSession session, const XrActionSpaceCreateInfo* info,
                                                   XrSpace* space) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_ACTION_SPACE_CREATE_INFO);
        verify(space != nullptr);
        const auto action = get<Action>(info->action);
        verify(&action->set().instance() == &object->instance(), XR_ERROR_HANDLE_INVALID);
        verify(action->type() == XR_ACTION_TYPE_POSE_INPUT, XR_ERROR_ACTION_TYPE_MISMATCH);
        verify(is_valid(info->poseInActionSpace), XR_ERROR_POSE_INVALID);
        if (info->subactionPath != XR_NULL_PATH) {
            object->instance().paths().text(info->subactionPath);
            verify(action->has_subaction_path(info->subactionPath), XR_ERROR_PATH_UNSUPPORTED);
        }
        *space = add_object(std::make_shared<Space>(object, Space::ActionSource{action, info->subactionPath},
                                                    from_xr(info->poseInActionSpace)),
                            object->id());
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrLocateSpace(XrSpace space, XrSpace base, XrTime time,
                                             XrSpaceLocation* location) {
    return guarded([&] {
        const auto object = get<Space>(space), base_object = get<Space>(base);
        verify_structure(location, XR_TYPE_SPACE_LOCATION);
        verify(&object->session() == &base_object->session());
        verify(time > 0, XR_ERROR_TIME_INVALID);
        const SpaceLocation found = locate(*object, *base_object, time);
        location->locationFlags = found.flags;
        location->pose = to_xr(found.base_from_space);
        if (auto* out = find_output<XrSpaceVelocity>(location->next, XR_TYPE_SPACE_VELOCITY)) {
            const Velocity moving = velocity(*object, *base_object, time);
            out->velocityFlags = velocity_flags(moving);
            out->linearVelocity = to_xr(moving.linear);
            out->angularVelocity = to_xr(moving.angular);
        }
        if (auto* out = find_output<XrEyeGazeSampleTimeEXT>(location->next, XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT);
            out && object->session().instance().has(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME)) {
            out->time = found.sample_time;
        }
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrLocateSpaces(XrSession session, const XrSpacesLocateInfo* info,
                                              XrSpaceLocations* locations) {
    return guarded([&] { locate_spaces(session, info, locations); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrLocateSpacesKHR(XrSession session, const XrSpacesLocateInfo* info,
                                                 XrSpaceLocations* locations) {
    return guarded([&] { locate_spaces(session, info, locations); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrDestroySpace(XrSpace space) {
    return guarded([&] { destroy<Space>(space); });
}

}  // namespace foveray::simulator
