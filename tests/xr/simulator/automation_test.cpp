// XR_EXT_conformance_automation: the client drives the inputs itself.
#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/action_client.h"

namespace foveray::simulator_tests {
namespace {

const char* const select_path = "/user/hand/left/input/select/click";

class Automation : public testing::Test {
  protected:
    Automation() {
        set_environment({});
        auto client = std::make_unique<SimulatorClient>(headless_extensions);
        client->create_headless_session();
        client->begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
        actions_ = std::make_unique<ActionClient>(std::move(client));
        set_ = actions_->create_set("set");
        client_ = actions_->client.get();
    }

    XrResult set_active(const std::string& profile, const std::string& user, bool active) {
        return client_->function<PFN_xrSetInputDeviceActiveEXT>("xrSetInputDeviceActiveEXT")(
            client_->session, client_->path("/interaction_profiles/" + profile), client_->path(user), active);
    }
    XrResult set_boolean(const std::string& user, const std::string& path, bool value) {
        return client_->function<PFN_xrSetInputDeviceStateBoolEXT>("xrSetInputDeviceStateBoolEXT")(
            client_->session, client_->path(user), client_->path(path), value);
    }
    XrResult set_float(const std::string& user, const std::string& path, float value) {
        return client_->function<PFN_xrSetInputDeviceStateFloatEXT>("xrSetInputDeviceStateFloatEXT")(
            client_->session, client_->path(user), client_->path(path), value);
    }
    XrResult set_vector(const std::string& user, const std::string& path, XrVector2f value) {
        return client_->function<PFN_xrSetInputDeviceStateVector2fEXT>("xrSetInputDeviceStateVector2fEXT")(
            client_->session, client_->path(user), client_->path(path), value);
    }
    XrResult sync() { return actions_->sync({{set_, XR_NULL_PATH}}); }
    bool profile_changed() {
        client_->take_states();
        return !client_->other_events.empty() &&
               client_->other_events.back().type == XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED;
    }

    std::unique_ptr<ActionClient> actions_;
    SimulatorClient* client_ = nullptr;
    XrActionSet set_ = XR_NULL_HANDLE;
};

TEST_F(Automation, DevicesComeAndGoWithXrSyncActions) {
    const XrAction fire = actions_->create(set_, "fire", XR_ACTION_TYPE_BOOLEAN_INPUT);
    ASSERT_XR_SUCCESS(actions_->suggest("khr/simple_controller", {{fire, select_path}}));
    ASSERT_XR_SUCCESS(actions_->attach({set_}));
    ASSERT_XR_SUCCESS(sync());
    EXPECT_FALSE(actions_->read_boolean(fire).isActive);
    EXPECT_FALSE(profile_changed());

    ASSERT_XR_SUCCESS(set_active("khr/simple_controller", "/user/hand/left", true));
    ASSERT_XR_SUCCESS(set_boolean("/user/hand/left", select_path, true));
    EXPECT_FALSE(actions_->read_boolean(fire).isActive) << "not synced yet";
    ASSERT_XR_SUCCESS(sync());
    EXPECT_TRUE(profile_changed());
    EXPECT_EQ(actions_->current_profile(actions_->hands[0]),
              client_->path("/interaction_profiles/khr/simple_controller"));
    EXPECT_EQ(actions_->current_profile(actions_->hands[1]), XR_NULL_PATH);
    EXPECT_TRUE(actions_->read_boolean(fire).currentState);
    EXPECT_FALSE(actions_->read_boolean(fire).changedSinceLastSync) << "it was not active before";

    ASSERT_XR_SUCCESS(set_boolean("/user/hand/left", select_path, false));
    ASSERT_XR_SUCCESS(sync());
    EXPECT_TRUE(actions_->read_boolean(fire).changedSinceLastSync);
    EXPECT_GT(actions_->read_boolean(fire).lastChangeTime, 0);

    ASSERT_XR_SUCCESS(set_active("khr/simple_controller", "/user/hand/left", false));
    EXPECT_TRUE(actions_->read_boolean(fire).isActive);
    ASSERT_XR_SUCCESS(sync());
    EXPECT_TRUE(profile_changed());
    const XrActionStateBoolean off = actions_->read_boolean(fire);
    EXPECT_FALSE(off.isActive || off.currentState || off.changedSinceLastSync);
    EXPECT_EQ(off.lastChangeTime, 0);
}

TEST_F(Automation, TheDevicesOwnProfileComesFirstWhereItWasSuggested) {
    const XrAction fire = actions_->create(set_, "fire", XR_ACTION_TYPE_BOOLEAN_INPUT);
    ASSERT_XR_SUCCESS(actions_->suggest("khr/simple_controller", {{fire, select_path}}));
    ASSERT_XR_SUCCESS(actions_->suggest("valve/index_controller", {{fire, "/user/hand/left/input/a/click"}}));
    ASSERT_XR_SUCCESS(actions_->attach({set_}));
    const XrPath simple = client_->path("/interaction_profiles/khr/simple_controller"),
                 index = client_->path("/interaction_profiles/valve/index_controller");
    ASSERT_XR_SUCCESS(set_active("valve/index_controller", "/user/hand/left", true));
    ASSERT_XR_SUCCESS(sync());
    EXPECT_EQ(actions_->current_profile(actions_->hands[0]), index);
    ASSERT_XR_SUCCESS(set_active("khr/simple_controller", "/user/hand/left", true));
    ASSERT_XR_SUCCESS(sync());
    EXPECT_EQ(actions_->current_profile(actions_->hands[0]), simple);
    ASSERT_XR_SUCCESS(set_active("htc/vive_controller", "/user/hand/left", true));
    ASSERT_XR_SUCCESS(sync());
    EXPECT_EQ(actions_->current_profile(actions_->hands[0]), simple) << "not suggested: the first other one";
}

TEST_F(Automation, ValuesCombineAndConvert) {
    const XrAction pull = actions_->create(set_, "pull", XR_ACTION_TYPE_FLOAT_INPUT),
                   press = actions_->create(set_, "press", XR_ACTION_TYPE_BOOLEAN_INPUT),
                   move = actions_->create(set_, "move", XR_ACTION_TYPE_VECTOR2F_INPUT),
                   move_x = actions_->create(set_, "move_x", XR_ACTION_TYPE_FLOAT_INPUT),
                   both = actions_->create(set_, "both", XR_ACTION_TYPE_FLOAT_INPUT),
                   click = actions_->create(set_, "click", XR_ACTION_TYPE_FLOAT_INPUT);
    const std::string hand = "/user/hand/right";
    ASSERT_XR_SUCCESS(actions_->suggest("valve/index_controller", {{pull, hand + "/input/trigger/value"},
                                                                   {press, hand + "/input/trigger/value"},
                                                                   {move, hand + "/input/thumbstick"},
                                                                   {move_x, hand + "/input/thumbstick/x"},
                                                                   {both, hand + "/input/trigger/value"},
                                                                   {both, hand + "/input/thumbstick/y"},
                                                                   {click, hand + "/input/a/click"}}));
    ASSERT_XR_SUCCESS(actions_->attach({set_}));
    ASSERT_XR_SUCCESS(set_active("valve/index_controller", hand, true));
    ASSERT_XR_SUCCESS(set_float(hand, hand + "/input/trigger/value", 0.75f));
    ASSERT_XR_SUCCESS(set_vector(hand, hand + "/input/thumbstick", {0.25f, -1.0f}));
    ASSERT_XR_SUCCESS(set_boolean(hand, hand + "/input/a/click", true));
    ASSERT_XR_SUCCESS(sync());
    EXPECT_FLOAT_EQ(actions_->read_float(pull).currentState, 0.75f);
    EXPECT_TRUE(actions_->read_boolean(press).currentState);
    EXPECT_FLOAT_EQ(actions_->read_vector(move).currentState.y, -1.0f);
    EXPECT_FLOAT_EQ(actions_->read_float(move_x).currentState, 0.25f) << "a component of the stick";
    EXPECT_FLOAT_EQ(actions_->read_float(both).currentState, -1.0f) << "the largest deflection";
    EXPECT_FLOAT_EQ(actions_->read_float(click).currentState, 1.0f);
    ASSERT_XR_SUCCESS(set_float(hand, hand + "/input/thumbstick/x", -0.5f));
    ASSERT_XR_SUCCESS(sync());
    EXPECT_FLOAT_EQ(actions_->read_vector(move).currentState.x, -0.5f);
}

TEST_F(Automation, APoseStaysWithItsFirstDevice) {
    const XrAction hand = actions_->create(set_, "hand", XR_ACTION_TYPE_POSE_INPUT);
    ASSERT_XR_SUCCESS(actions_->suggest(
        "khr/simple_controller",
        {{hand, "/user/hand/left/input/grip/pose"}, {hand, "/user/hand/right/input/grip/pose"}}));
    ASSERT_XR_SUCCESS(actions_->attach({set_}));
    const XrSpace any = actions_->create_space(hand), left = actions_->create_space(hand, actions_->hands[0]),
                  right = actions_->create_space(hand, actions_->hands[1]),
                  stage = client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    const auto is_located = [&](XrSpace space) {
        return client_->locate(space, stage, nanoseconds_per_second).locationFlags != 0;
    };
    const auto turn = [&](bool left_on, bool right_on) {
        EXPECT_EQ(set_active("khr/simple_controller", "/user/hand/left", left_on), XR_SUCCESS);
        EXPECT_EQ(set_active("khr/simple_controller", "/user/hand/right", right_on), XR_SUCCESS);
    };
    turn(true, true);
    EXPECT_FALSE(is_located(left)) << "not synced yet";
    ASSERT_XR_SUCCESS(sync());
    EXPECT_TRUE(is_located(left) && is_located(right) && is_located(any));
    turn(false, true);
    EXPECT_FALSE(is_located(left) || is_located(any)) << "at once";
    EXPECT_TRUE(actions_->is_pose_active(hand, actions_->hands[0])) << "but the state stays as synced";
    ASSERT_XR_SUCCESS(sync());
    EXPECT_TRUE(is_located(right));
    EXPECT_FALSE(is_located(any) || actions_->is_pose_active(hand)) << "the other hand does not take over";
    turn(false, false);
    ASSERT_XR_SUCCESS(sync());
    EXPECT_FALSE(is_located(any) || is_located(right));
    turn(true, true);
    ASSERT_XR_SUCCESS(sync());
    EXPECT_TRUE(is_located(any));
    ASSERT_XR_SUCCESS(xrDestroyAction(hand));
    ASSERT_XR_SUCCESS(sync());
    EXPECT_TRUE(is_located(any) && is_located(left)) << "spaces outlive their action";
}

TEST_F(Automation, PosesAreSetRelativeToASpace) {
    const XrAction hand = actions_->create(set_, "hand", XR_ACTION_TYPE_POSE_INPUT);
    ASSERT_XR_SUCCESS(
        actions_->suggest("khr/simple_controller", {{hand, "/user/hand/left/input/grip/pose"}}));
    ASSERT_XR_SUCCESS(actions_->attach({set_}));
    const XrSpace grip = actions_->create_space(hand),
                  base = client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE, {{0, 0, 0, 1}, {0, 2, 0}}),
                  stage = client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    const auto set_location =
        client_->function<PFN_xrSetInputDeviceLocationEXT>("xrSetInputDeviceLocationEXT");
    const XrPath left = actions_->hands[0], source = client_->path("/user/hand/left/input/grip/pose");
    ASSERT_XR_SUCCESS(set_active("khr/simple_controller", "/user/hand/left", true));
    ASSERT_XR_SUCCESS(set_location(client_->session, left, source, base, {{0, 0, 0, 1}, {1, 0, -3}}));
    ASSERT_XR_SUCCESS(sync());
    const XrSpaceLocation location = client_->locate(grip, stage, nanoseconds_per_second);
    EXPECT_EQ(location.locationFlags, XrSpaceLocationFlags{15});
    EXPECT_FLOAT_EQ(location.pose.position.x, 1.0f);
    EXPECT_FLOAT_EQ(location.pose.position.y, 2.0f);
    EXPECT_FLOAT_EQ(location.pose.position.z, -3.0f);
    EXPECT_EQ(set_location(client_->session, left, source, base, {{0, 0, 0, 0}, {1, 0, -3}}),
              XR_ERROR_POSE_INVALID);
    EXPECT_EQ(set_location(client_->session, left, source, XR_NULL_HANDLE, {{0, 0, 0, 1}, {1, 0, -3}}),
              XR_ERROR_HANDLE_INVALID);
}

TEST_F(Automation, PathsAreVerified) {
    EXPECT_EQ(set_active("khr/no_controller", "/user/hand/left", true), XR_ERROR_PATH_UNSUPPORTED);
    EXPECT_EQ(set_active("khr/simple_controller", "/user/gamepad", true), XR_ERROR_PATH_UNSUPPORTED);
    EXPECT_EQ(set_active("khr/simple_controller", "/user/invalid", true), XR_ERROR_PATH_UNSUPPORTED);
    EXPECT_EQ(set_boolean("/user/hand/right", select_path, true), XR_ERROR_PATH_UNSUPPORTED)
        << "of the other hand";
    EXPECT_EQ(set_float("/user/hand/left", select_path, 1.0f), XR_ERROR_PATH_UNSUPPORTED)
        << "of another type";
    EXPECT_EQ(client_->function<PFN_xrSetInputDeviceStateBoolEXT>("xrSetInputDeviceStateBoolEXT")(
                  client_->session, actions_->hands[0], 0x1234, XR_TRUE),
              XR_ERROR_PATH_INVALID);
}

TEST(AutomationAndScript, TheFirstCallTakesTheScriptsControllersAway) {
    fakes::TemporaryFolder folder;
    Session script = make_session(100);
    ControllerState state;
    state.valid = true;
    state.trigger = 1.0f;
    script.controllers = {{0, 0, state}};
    write_session(folder.path() / "s", script);
    set_environment({{"SESSION", folder.path() / "s"}});
    auto client = std::make_unique<SimulatorClient>(headless_extensions);
    client->create_headless_session();
    client->begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    ActionClient actions(std::move(client));
    const XrActionSet set = actions.create_set("set");
    const XrAction fire = actions.create(set, "fire", XR_ACTION_TYPE_BOOLEAN_INPUT);
    ASSERT_XR_SUCCESS(actions.suggest("khr/simple_controller", {{fire, select_path}}));
    ASSERT_XR_SUCCESS(actions.attach({set}));
    ASSERT_XR_SUCCESS(actions.sync({{set, XR_NULL_PATH}}));
    EXPECT_TRUE(actions.read_boolean(fire).currentState);
    SimulatorClient& c = *actions.client;
    ASSERT_XR_SUCCESS(c.function<PFN_xrSetInputDeviceStateBoolEXT>("xrSetInputDeviceStateBoolEXT")(
        c.session, actions.hands[0], c.path(select_path), XR_FALSE));
    ASSERT_XR_SUCCESS(actions.sync({{set, XR_NULL_PATH}}));
    EXPECT_FALSE(actions.read_boolean(fire).isActive);
}

}  // namespace
}  // namespace foveray::simulator_tests
