// Actions: bindings, states, profiles, errors.
#include <cstring>

#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/action_client.h"

namespace foveray::simulator_tests {
namespace {

class Actions : public testing::Test {
  protected:
    Actions() {
        Session script = make_session(60);
        ControllerState state;
        state.valid = true;
        state.stage_from_grip.position = vec3(0.2f, 1.0f, -0.3f);
        state.stage_from_aim = state.stage_from_grip;
        script.controllers.push_back({0, 1, state});
        state.trigger = 0.75f;
        state.thumbstick = vec2(-0.5f, 0.25f);
        state.primary_button = true;
        script.controllers.push_back({from_seconds(1 / 30.0), 1, state});
        write_session(folder_.path() / "s", script);
        set_environment({{"SESSION", folder_.path() / "s"}, {"PROFILE", "ci-stereo"}});
        auto client = std::make_unique<SimulatorClient>();
        client->create_session();
        actions_ = std::make_unique<ActionClient>(std::move(client));
        set_ = actions_->create_set("set");
        hands_ = actions_->hands;
        client_ = actions_->client.get();
    }

    XrAction create(const char* name, XrActionType type) { return actions_->create(set_, name, type); }
    XrResult suggest(const std::string& profile, const std::vector<std::pair<XrAction, std::string>>& list) {
        return actions_->suggest(profile, list);
    }
    XrResult attach() { return actions_->attach({set_}); }
    XrResult sync() { return actions_->sync({{set_, XR_NULL_PATH}}); }

    fakes::TemporaryFolder folder_;
    std::unique_ptr<ActionClient> actions_;
    SimulatorClient* client_ = nullptr;
    XrActionSet set_ = XR_NULL_HANDLE;
    std::array<XrPath, 2> hands_{};
};

TEST_F(Actions, ReadTheScriptedController) {
    const XrAction pull = create("pull", XR_ACTION_TYPE_FLOAT_INPUT),
                   fire = create("fire", XR_ACTION_TYPE_BOOLEAN_INPUT),
                   move = create("move", XR_ACTION_TYPE_VECTOR2F_INPUT),
                   button = create("button", XR_ACTION_TYPE_BOOLEAN_INPUT),
                   hand = create("hand", XR_ACTION_TYPE_POSE_INPUT),
                   buzz = create("buzz", XR_ACTION_TYPE_VIBRATION_OUTPUT);
    ASSERT_XR_SUCCESS(suggest("oculus/touch_controller", {{pull, "/user/hand/left/input/trigger/value"},
                                                          {pull, "/user/hand/right/input/trigger/value"},
                                                          {fire, "/user/hand/right/input/trigger"},
                                                          {move, "/user/hand/right/input/thumbstick"},
                                                          {button, "/user/hand/right/input/a/click"},
                                                          {hand, "/user/hand/left/input/grip/pose"},
                                                          {hand, "/user/hand/right/input/grip/pose"},
                                                          {buzz, "/user/hand/right/output/haptic"}}));
    ASSERT_XR_SUCCESS(attach());
    client_->begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    EXPECT_EQ(sync(), XR_SESSION_NOT_FOCUSED);
    client_->empty_frame();
    ASSERT_XR_SUCCESS(sync());
    client_->take_states();
    ASSERT_EQ(client_->other_events.size(), 1u);
    EXPECT_EQ(client_->other_events[0].type, XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED);

    EXPECT_FALSE(actions_->read_float(pull, hands_[0]).isActive);
    EXPECT_EQ(actions_->read_float(pull, hands_[1]).currentState, 0.0f);

    client_->empty_frame();
    ASSERT_XR_SUCCESS(sync());
    const auto pulled = actions_->read_float(pull);
    EXPECT_TRUE(pulled.isActive);
    EXPECT_TRUE(pulled.changedSinceLastSync);
    EXPECT_GT(pulled.lastChangeTime, 0);
    EXPECT_FLOAT_EQ(pulled.currentState, 0.75f);
    EXPECT_TRUE(actions_->read_boolean(fire).currentState);
    EXPECT_TRUE(actions_->read_boolean(button).currentState);
    const auto moved = actions_->read_vector(move).currentState;
    EXPECT_FLOAT_EQ(moved.x, -0.5f);
    EXPECT_FLOAT_EQ(moved.y, 0.25f);
    ASSERT_XR_SUCCESS(sync());
    EXPECT_FALSE(actions_->read_float(pull).changedSinceLastSync);

    EXPECT_TRUE(actions_->is_pose_active(hand, hands_[1]));
    const XrActionSpaceCreateInfo space_info{
        XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, hand, hands_[1], {{0, 0, 0, 1}, {0, 0, 0}}};
    XrSpace grip = XR_NULL_HANDLE;
    ASSERT_XR_SUCCESS(xrCreateActionSpace(client_->session, &space_info, &grip));
    const XrTime time = client_->empty_frame().predictedDisplayTime;
    const auto location =
        client_->locate(grip, client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE), time);
    EXPECT_EQ(location.locationFlags, XrSpaceLocationFlags{15});
    EXPECT_FLOAT_EQ(location.pose.position.z, -0.3f);

    const XrHapticVibration vibration{XR_TYPE_HAPTIC_VIBRATION, nullptr, XR_MIN_HAPTIC_DURATION, 0.0f, 0.5f};
    const XrHapticActionInfo haptic{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, buzz, hands_[1]};
    EXPECT_EQ(xrApplyHapticFeedback(client_->session, &haptic,
                                    reinterpret_cast<const XrHapticBaseHeader*>(&vibration)),
              XR_SUCCESS);
    EXPECT_EQ(xrStopHapticFeedback(client_->session, &haptic), XR_SUCCESS);
}

TEST_F(Actions, SourcesAndProfilesHaveNames) {
    const XrAction pull = create("pull", XR_ACTION_TYPE_FLOAT_INPUT);
    ASSERT_XR_SUCCESS(suggest("khr/simple_controller", {{pull, "/user/hand/right/input/select/click"}}));
    ASSERT_XR_SUCCESS(suggest("oculus/touch_controller", {{pull, "/user/hand/right/input/trigger/value"}}));
    XrInteractionProfileState profile{XR_TYPE_INTERACTION_PROFILE_STATE, nullptr, 0};
    EXPECT_EQ(xrGetCurrentInteractionProfile(client_->session, hands_[1], &profile),
              XR_ERROR_ACTIONSET_NOT_ATTACHED);
    ASSERT_XR_SUCCESS(attach());
    ASSERT_XR_SUCCESS(xrGetCurrentInteractionProfile(client_->session, hands_[1], &profile));
    EXPECT_EQ(profile.interactionProfile, XR_NULL_PATH) << "chosen by xrSyncActions only";
    client_->begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    client_->empty_frame();
    ASSERT_XR_SUCCESS(sync());
    ASSERT_XR_SUCCESS(xrGetCurrentInteractionProfile(client_->session, hands_[0], &profile));
    EXPECT_EQ(profile.interactionProfile, XR_NULL_PATH) << "the script has no left controller";
    ASSERT_XR_SUCCESS(xrGetCurrentInteractionProfile(client_->session, hands_[1], &profile));
    EXPECT_EQ(profile.interactionProfile, client_->path("/interaction_profiles/oculus/touch_controller"))
        << "the headset's own controllers come first";

    const XrBoundSourcesForActionEnumerateInfo info{XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO, nullptr,
                                                    pull};
    XrPath source = XR_NULL_PATH;
    std::uint32_t count = 0;
    ASSERT_XR_SUCCESS(xrEnumerateBoundSourcesForAction(client_->session, &info, 1, &count, &source));
    EXPECT_EQ(source, client_->path("/user/hand/right/input/trigger/value"));
    const XrInputSourceLocalizedNameGetInfo name_info{XR_TYPE_INPUT_SOURCE_LOCALIZED_NAME_GET_INFO, nullptr,
                                                      source, 7};
    char name[64];
    ASSERT_XR_SUCCESS(xrGetInputSourceLocalizedName(client_->session, &name_info, sizeof name, &count, name));
    EXPECT_STREQ(name, "Right Hand Touch Controller Trigger value");
}

TEST_F(Actions, RefuseWhatTheSpecificationForbids) {
    const XrAction pull = create("pull", XR_ACTION_TYPE_FLOAT_INPUT);
    XrActionCreateInfo info{};
    info.type = XR_TYPE_ACTION_CREATE_INFO;
    info.actionType = XR_ACTION_TYPE_FLOAT_INPUT;
    XrAction ignored = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateAction(set_, &info, &ignored), XR_ERROR_NAME_INVALID);
    std::strcpy(info.actionName, "No Path");
    std::strcpy(info.localizedActionName, "x");
    EXPECT_EQ(xrCreateAction(set_, &info, &ignored), XR_ERROR_PATH_FORMAT_INVALID);
    std::strcpy(info.actionName, "pull");
    EXPECT_EQ(xrCreateAction(set_, &info, &ignored), XR_ERROR_NAME_DUPLICATED);
    std::strcpy(info.actionName, "other");
    std::strcpy(info.localizedActionName, "pull");
    EXPECT_EQ(xrCreateAction(set_, &info, &ignored), XR_ERROR_LOCALIZED_NAME_DUPLICATED);
    const XrActionSetCreateInfo same_set{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "set", "Other", 0};
    XrActionSet set = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateActionSet(client_->instance, &same_set, &set), XR_ERROR_NAME_DUPLICATED);

    EXPECT_EQ(suggest("oculus/no_controller", {{pull, "/user/hand/left/input/trigger/value"}}),
              XR_ERROR_PATH_UNSUPPORTED);
    EXPECT_EQ(suggest("oculus/touch_controller", {{pull, "/user/hand/left/input/a/click"}}),
              XR_ERROR_PATH_UNSUPPORTED);
    EXPECT_EQ(suggest("oculus/touch_controller", {}), XR_ERROR_VALIDATION_FAILURE);

    const XrActionStateGetInfo get{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, pull, XR_NULL_PATH};
    XrActionStateFloat state{};
    state.type = XR_TYPE_ACTION_STATE_FLOAT;
    EXPECT_EQ(xrGetActionStateFloat(client_->session, &get, &state), XR_ERROR_ACTIONSET_NOT_ATTACHED);
    EXPECT_EQ(sync(), XR_ERROR_ACTIONSET_NOT_ATTACHED);
    ASSERT_XR_SUCCESS(attach());
    EXPECT_EQ(attach(), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
    std::strcpy(info.localizedActionName, "other");
    EXPECT_EQ(xrCreateAction(set_, &info, &ignored), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
    EXPECT_EQ(suggest("khr/simple_controller", {{pull, "/user/hand/left/input/select/click"}}),
              XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
    XrActionStateBoolean wrong{};
    wrong.type = XR_TYPE_ACTION_STATE_BOOLEAN;
    EXPECT_EQ(xrGetActionStateBoolean(client_->session, &get, &wrong), XR_ERROR_ACTION_TYPE_MISMATCH);
    const XrActionStateGetInfo elsewhere{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, pull,
                                         client_->path("/user/head")};
    EXPECT_EQ(xrGetActionStateFloat(client_->session, &elsewhere, &state), XR_ERROR_PATH_UNSUPPORTED);
}

}  // namespace
}  // namespace foveray::simulator_tests
