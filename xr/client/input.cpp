#include "xr/client/input.h"

#include <cstring>

#include "base/log.h"

namespace foveray::xr {
namespace {

constexpr XrSpaceLocationFlags pose_valid =
    XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;

SpaceHandle make_space(XrSession session, XrAction action, XrPath subaction) {
    XrActionSpaceCreateInfo info{XR_TYPE_ACTION_SPACE_CREATE_INFO};
    info.action = action;
    info.subactionPath = subaction;
    info.poseInActionSpace = to_xr(Pose{});
    SpaceHandle space;
    check(xrCreateActionSpace(session, &info, space.put()), "xrCreateActionSpace");
    return space;
}

bool locate(XrSpace space, XrSpace stage, XrTime time, Pose& pose) {
    XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
    check(xrLocateSpace(space, stage, time, &location), "xrLocateSpace");
    if ((location.locationFlags & pose_valid) != pose_valid) return false;
    pose = to_pose(location.pose);
    return true;
}

}  // namespace

Input::Input(const Instance& instance, XrSession session) {
    hands_ = {instance.path("/user/hand/left"), instance.path("/user/hand/right")};
    XrActionSetCreateInfo set_info{XR_TYPE_ACTION_SET_CREATE_INFO};
    std::strcpy(set_info.actionSetName, "viewer");
    std::strcpy(set_info.localizedActionSetName, "Viewer");
    check(xrCreateActionSet(instance.get(), &set_info, action_set_.put()), "xrCreateActionSet");

    grip_ = make_action("grip", "Hand", XR_ACTION_TYPE_POSE_INPUT, true);
    aim_ = make_action("aim", "Pointer", XR_ACTION_TYPE_POSE_INPUT, true);
    trigger_ = make_action("trigger", "Trigger", XR_ACTION_TYPE_FLOAT_INPUT, true);
    squeeze_ = make_action("squeeze", "Squeeze", XR_ACTION_TYPE_FLOAT_INPUT, true);
    thumbstick_ = make_action("thumbstick", "Thumbstick", XR_ACTION_TYPE_VECTOR2F_INPUT, true);
    primary_ = make_action("primary", "Primary button", XR_ACTION_TYPE_BOOLEAN_INPUT, true);
    secondary_ = make_action("secondary", "Secondary button", XR_ACTION_TYPE_BOOLEAN_INPUT, true);
    if (instance.has_eye_tracking()) gaze_ = make_action("gaze", "Gaze", XR_ACTION_TYPE_POSE_INPUT, false);
    suggest(instance);

    const XrActionSet set = action_set_.get();
    XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set};
    check(xrAttachSessionActionSets(session, &attach), "xrAttachSessionActionSets");
    for (int hand = 0; hand < 2; ++hand) {
        grip_space_[hand] = make_space(session, grip_, hands_[hand]);
        aim_space_[hand] = make_space(session, aim_, hands_[hand]);
    }
    if (gaze_ != XR_NULL_HANDLE) gaze_space_ = make_space(session, gaze_, XR_NULL_PATH);
}

XrAction Input::make_action(const char* name, const char* localized, XrActionType type, bool per_hand) {
    XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO};
    std::strcpy(info.actionName, name);
    std::strcpy(info.localizedActionName, localized);
    info.actionType = type;
    if (per_hand) {
        info.countSubactionPaths = static_cast<std::uint32_t>(hands_.size());
        info.subactionPaths = hands_.data();
    }
    XrAction action = XR_NULL_HANDLE;
    check(xrCreateAction(action_set_.get(), &info, &action), "xrCreateAction");
    return action;
}

void Input::suggest(const Instance& instance) const {
    struct Binding {
        XrAction action;
        const char* left;
        const char* right;  // null: as on the left
    };
    const auto suggest_for = [&](const char* profile,
                                 const std::vector<XrActionSuggestedBinding>& suggested) {
        const XrInteractionProfileSuggestedBinding info{
            XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr, instance.path(profile),
            static_cast<std::uint32_t>(suggested.size()), suggested.data()};
        const XrResult result = xrSuggestInteractionProfileBindings(instance.get(), &info);
        if (result == XR_ERROR_PATH_UNSUPPORTED) {
            log::debug("{} takes no bindings for {}", instance.runtime_name(), profile);
        } else {
            check(result, "xrSuggestInteractionProfileBindings");
        }
    };
    const auto suggest_hands = [&](const char* profile, std::initializer_list<Binding> bindings) {
        std::vector<XrActionSuggestedBinding> suggested;
        const auto add = [&](XrAction action, const char* hand, const char* input) {
            suggested.push_back(
                {action, instance.path((std::string("/user/hand/") + hand + "/input/" + input).c_str())});
        };
        const auto add_both = [&](const Binding& b) {
            add(b.action, "left", b.left);
            add(b.action, "right", b.right ? b.right : b.left);
        };
        add_both({grip_, "grip/pose", nullptr});
        add_both({aim_, "aim/pose", nullptr});
        for (const Binding& binding : bindings) add_both(binding);
        suggest_for(profile, suggested);
    };
    suggest_hands("/interaction_profiles/khr/simple_controller", {{primary_, "select/click", nullptr}});
    suggest_hands("/interaction_profiles/oculus/touch_controller", {{trigger_, "trigger/value", nullptr},
                                                                    {squeeze_, "squeeze/value", nullptr},
                                                                    {thumbstick_, "thumbstick", nullptr},
                                                                    {primary_, "x/click", "a/click"},
                                                                    {secondary_, "y/click", "b/click"}});
    suggest_hands("/interaction_profiles/valve/index_controller", {{trigger_, "trigger/value", nullptr},
                                                                   {squeeze_, "squeeze/value", nullptr},
                                                                   {thumbstick_, "thumbstick", nullptr},
                                                                   {primary_, "a/click", nullptr},
                                                                   {secondary_, "b/click", nullptr}});
    suggest_hands("/interaction_profiles/htc/vive_controller", {{trigger_, "trigger/value", nullptr},
                                                                {thumbstick_, "trackpad", nullptr},
                                                                {primary_, "menu/click", nullptr}});
    if (gaze_ != XR_NULL_HANDLE) {
        suggest_for("/interaction_profiles/ext/eye_gaze_interaction",
                    {{gaze_, instance.path("/user/eyes_ext/input/gaze_ext/pose")}});
    }
}

XrActionStateGetInfo Input::query(XrAction action, int hand) const {
    return {XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action, hands_[hand]};
}

float Input::read_float(XrSession session, XrAction action, int hand) const {
    XrActionStateFloat state{XR_TYPE_ACTION_STATE_FLOAT};
    const auto info = query(action, hand);
    check(xrGetActionStateFloat(session, &info, &state), "xrGetActionStateFloat");
    return state.isActive ? state.currentState : 0.0f;
}

bool Input::read_button(XrSession session, XrAction action, int hand) const {
    XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
    const auto info = query(action, hand);
    check(xrGetActionStateBoolean(session, &info, &state), "xrGetActionStateBoolean");
    return state.isActive && state.currentState;
}

void Input::update(XrSession session, XrSpace stage, Frame& frame) const {
    const XrActiveActionSet active{action_set_.get(), XR_NULL_PATH};
    const XrActionsSyncInfo sync{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
    if (check(xrSyncActions(session, &sync), "xrSyncActions") == XR_SESSION_NOT_FOCUSED) return;

    for (int hand = 0; hand < 2; ++hand) {
        ControllerState& controller = frame.controllers[hand];
        controller.valid =
            locate(grip_space_[hand].get(), stage, frame.display_time, controller.stage_from_grip);
        if (!controller.valid) continue;
        locate(aim_space_[hand].get(), stage, frame.display_time, controller.stage_from_aim);
        controller.trigger = read_float(session, trigger_, hand);
        controller.squeeze = read_float(session, squeeze_, hand);
        XrActionStateVector2f stick{XR_TYPE_ACTION_STATE_VECTOR2F};
        const auto info = query(thumbstick_, hand);
        check(xrGetActionStateVector2f(session, &info, &stick), "xrGetActionStateVector2f");
        if (stick.isActive) controller.thumbstick = {stick.currentState.x, stick.currentState.y};
        controller.primary_button = read_button(session, primary_, hand);
        controller.secondary_button = read_button(session, secondary_, hand);
    }

    if (!gaze_space_) return;
    XrEyeGazeSampleTimeEXT sample_time{XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT};
    XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, &sample_time};
    check(xrLocateSpace(gaze_space_.get(), stage, frame.display_time, &location), "xrLocateSpace");
    GazeSample& gaze = frame.gaze;
    gaze.valid = (location.locationFlags & pose_valid) == pose_valid &&
                 (location.locationFlags & XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT);
    gaze.time = sample_time.time;
    const Pose pose = to_pose(location.pose);
    gaze.valid = gaze.valid && is_usable(pose);
    if (!gaze.valid) return;
    gaze.origin = pose.position;
    gaze.direction = glm::normalize(pose.orientation) * vec3(0, 0, -1);
}

}  // namespace foveray::xr
