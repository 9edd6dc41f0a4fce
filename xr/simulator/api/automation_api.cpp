#include "xr/simulator/api/functions.h"
#include "xr/simulator/convert.h"
#include "xr/simulator/session.h"
#include "xr/simulator/space.h"

namespace foveray::simulator {
namespace {

std::string read_user_path(const Session& session, XrPath path) {
    std::string text = session.instance().paths().text(path);
    verify(is_user_path(text, session.instance().has(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME)),
           XR_ERROR_PATH_UNSUPPORTED);
    return text;
}

const InputSource& read_source(const Session& session, XrPath user_path, XrPath path, InputKind kind) {
    const std::string user = read_user_path(session, user_path);
    const InputSource* source = find_source(session.instance().paths().text(path), kind);
    verify(source && source->user == user && session.instance().has(source->feature),
           XR_ERROR_PATH_UNSUPPORTED);
    return *source;
}

XrResult set_value(XrSession session, XrPath user_path, XrPath path, InputKind kind, vec2 value) {
    const auto object = get<Session>(session);
    const InputSource& source = read_source(*object, user_path, path, kind);
    verify(std::isfinite(value.x) && std::isfinite(value.y));
    object->devices().set_value(source, glm::clamp(value, -1.0f, 1.0f));
    return XR_SUCCESS;
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL xrSetInputDeviceActiveEXT(XrSession session, XrPath interaction_profile,
                                                         XrPath user_path, XrBool32 active) {
    return guarded([&] {
        const auto object = get<Session>(session);
        const InteractionProfile* profile =
            find_interaction_profile(object->instance().paths().text(interaction_profile));
        const std::string user = read_user_path(*object, user_path);
        verify(profile && profile->has_user(user) && object->instance().has(profile->feature),
               XR_ERROR_PATH_UNSUPPORTED);
        object->devices().set_active(user, *profile, active);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrSetInputDeviceStateBoolEXT(XrSession session, XrPath user_path, XrPath path,
                                                            XrBool32 state) {
    return guarded([&] {
        return set_value(session, user_path, path, InputKind::Boolean, vec2(state ? 1.0f : 0.0f, 0.0f));
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrSetInputDeviceStateFloatEXT(XrSession session, XrPath user_path, XrPath path,
                                                             float state) {
    return guarded([&] { return set_value(session, user_path, path, InputKind::Float, vec2(state, 0.0f)); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrSetInputDeviceStateVector2fEXT(XrSession session, XrPath user_path,
                                                                XrPath path, XrVector2f state) {
    return guarded(
        [&] { return set_value(session, user_path, path, InputKind::Vector2, vec2(state.x, state.y)); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrSetInputDeviceLocationEXT(XrSession session, XrPath user_path, XrPath path,
                                                           XrSpace space, XrPosef pose) {
    return guarded([&] {
        const auto object = get<Session>(session);
        const InputSource& source = read_source(*object, user_path, path, InputKind::Pose);
        const auto base = get<Space>(space);
        verify(&base->session() == object.get());
        verify(is_valid(pose), XR_ERROR_POSE_INVALID);
        Placement placement = base->place(object->instance().clock().now());
        placement.carrier_from_space = placement.carrier_from_space * from_xr(pose);
        object->devices().set_placement(source, placement);
    });
}

}  // namespace foveray::simulator
