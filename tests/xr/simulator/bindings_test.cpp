// Suggested bindings: priorities of action sets, which paths, names and sets may be used.
#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/action_client.h"

namespace foveray::simulator_tests {
namespace {

class Bindings : public testing::Test {
  protected:
    Bindings() { start({}); }

    void start(const std::map<std::string, std::string>& variables) {
        actions_.reset();
        set_environment(variables);
        auto client = std::make_unique<SimulatorClient>(headless_extensions);
        client->create_headless_session();
        actions_ = std::make_unique<ActionClient>(std::move(client));
    }

    /// Both hands hold controllers.
    void start_with_controllers() {
        Session script = make_session(1000);
        ControllerState state;
        state.valid = true;
        for (const int hand : {0, 1}) script.controllers.push_back({0, hand, state});
        write_session(folder_.path() / "s", script);
        start({{"SESSION", folder_.path() / "s"}, {"PROFILE", "ci-stereo"}});
        actions_->client->begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    }

    fakes::TemporaryFolder folder_;
    std::unique_ptr<ActionClient> actions_;
};

constexpr auto boolean = XR_ACTION_TYPE_BOOLEAN_INPUT;
constexpr auto pose = XR_ACTION_TYPE_POSE_INPUT;

TEST_F(Bindings, UnknownProfilesAndPathsAreRefused) {
    const XrAction fire = actions_->create(actions_->create_set("set"), "fire", boolean);
    for (const char* profile : {"invalid", "khr/another_controller", "khr/simple_controller/invalid"}) {
        EXPECT_EQ(actions_->suggest(profile, {{fire, "/user/hand/left/input/select/click"}}),
                  XR_ERROR_PATH_UNSUPPORTED)
            << profile;
    }
    for (const char* path :
         {"/invalid", "/user/invalid", "/user/hand/right", "/user/hand/right/invalid",
          "/user/hand/right/input", "/user/hand/right/output", "/user/hand/invalid/input",
          "/user/hand/left/input_bad/menu/click", "/user/hand/right/input/select/click/invalid",
          "/user/hand/right/input/trackpad"}) {
        EXPECT_EQ(actions_->suggest("khr/simple_controller", {{fire, path}}), XR_ERROR_PATH_UNSUPPORTED)
            << path;
    }
    for (const char* path : {"/user/hand/right/input", "/user/hand/right/output"}) {
        EXPECT_EQ(actions_->suggest("valve/index_controller", {{fire, path}}), XR_ERROR_PATH_UNSUPPORTED)
            << path;
    }
    EXPECT_EQ(actions_->suggest("khr/simple_controller", {{fire, "/user/hand/right/input/select"}}),
              XR_SUCCESS)
        << "an input may be named without its component";
}

TEST_F(Bindings, EyeGazeNeedsItsExtension) {
    actions_.reset();
    set_environment({});
    auto client = std::make_unique<SimulatorClient>(std::vector<const char*>{XR_MND_HEADLESS_EXTENSION_NAME});
    actions_ = std::make_unique<ActionClient>(std::move(client));
    const XrAction gaze = actions_->create(actions_->create_set("set"), "gaze", pose);
    EXPECT_EQ(actions_->suggest("ext/eye_gaze_interaction", {{gaze, "/user/eyes_ext/input/gaze_ext/pose"}}),
              XR_ERROR_PATH_UNSUPPORTED);
}

TEST_F(Bindings, LaterSuggestionsReplaceEarlierOnesAndDuplicatesAreOne) {
    start_with_controllers();
    const XrActionSet set = actions_->create_set("set");
    const XrAction first = actions_->create(set, "first", boolean),
                   second = actions_->create(set, "second", boolean);
    const char* const select = "/user/hand/left/input/select/click";
    ASSERT_XR_SUCCESS(actions_->suggest("khr/simple_controller", {{first, select}}));
    ASSERT_XR_SUCCESS(
        actions_->suggest("khr/simple_controller",
                          {{second, select}, {second, select}, {second, "/user/hand/left/input/select"}}));
    ASSERT_XR_SUCCESS(actions_->attach({set}));
    ASSERT_XR_SUCCESS(actions_->sync({{set, XR_NULL_PATH}}));
    EXPECT_FALSE(actions_->read_boolean(first).isActive);
    EXPECT_TRUE(actions_->read_boolean(second).isActive);
    const XrBoundSourcesForActionEnumerateInfo info{XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO, nullptr,
                                                    second};
    std::uint32_t count = 0;
    ASSERT_XR_SUCCESS(xrEnumerateBoundSourcesForAction(actions_->client->session, &info, 0, &count, nullptr));
    EXPECT_EQ(count, 1u);
}

TEST_F(Bindings, ASourceBelongsToTheSetOfTheHighestPriority) {
    start_with_controllers();
    const XrActionSet high = actions_->create_set("high", 3), low = actions_->create_set("low", 2);
    const XrAction high_select = actions_->create(high, "high_select", boolean),
                   low_select = actions_->create(low, "low_select", boolean),
                   low_menu = actions_->create(low, "low_menu", boolean),
                   low_both = actions_->create(low, "low_both", boolean);
    std::vector<std::pair<XrAction, std::string>> list;
    for (const std::string hand : {"/user/hand/left", "/user/hand/right"}) {
        for (const XrAction action : {high_select, low_select, low_both})
            list.emplace_back(action, hand + "/input/select/click");
        for (const XrAction action : {low_menu, low_both})
            list.emplace_back(action, hand + "/input/menu/click");
    }
    ASSERT_XR_SUCCESS(actions_->suggest("khr/simple_controller", list));
    ASSERT_XR_SUCCESS(actions_->attach({high, low}));
    const auto [left, right] = actions_->hands;

    struct Case {
        std::vector<XrActiveActionSet> active;
        // Active through: no subaction path, left, right.
        std::array<bool, 3> high_select, low_select, low_menu, low_both;
    };
    const std::array<bool, 3> all{true, true, true}, none{false, false, false}, on_left{true, true, false},
        on_right{true, false, true};
    const Case cases[] = {
        {{{low, left}, {low, right}, {high, left}, {high, right}}, all, none, all, all},
        {{{high, XR_NULL_PATH}, {low, XR_NULL_PATH}}, all, none, all, all},
        {{{high, right}, {low, right}}, on_right, none, on_right, on_right},
        {{{high, right}, {low, left}}, on_right, on_left, on_left, on_left},
        {{{high, right}, {low, XR_NULL_PATH}}, on_right, on_left, all, all},
        {{{low, XR_NULL_PATH}}, none, all, all, all},
        {{}, none, none, none, none},
    };
    for (const Case& c : cases) {
        ASSERT_XR_SUCCESS(actions_->sync(c.active));
        const auto expect = [&](XrAction action, const std::array<bool, 3>& expected, const char* name) {
            for (int i = 0; i < 3; ++i) {
                const XrPath path = i == 0 ? XR_NULL_PATH : actions_->hands[i - 1];
                EXPECT_EQ(bool(actions_->read_boolean(action, path).isActive), expected[i])
                    << name << ' ' << i << " case " << &c - cases;
            }
        };
        expect(high_select, c.high_select, "high_select");
        expect(low_select, c.low_select, "low_select");
        expect(low_menu, c.low_menu, "low_menu");
        expect(low_both, c.low_both, "low_both");
    }
}

TEST_F(Bindings, NamesAreFreeAgainOnceTheirOwnerIsDestroyed) {
    const XrActionSet set = actions_->create_set("set");
    const XrAction fire = actions_->create(set, "fire", boolean);
    ASSERT_XR_SUCCESS(
        actions_->suggest("khr/simple_controller", {{fire, "/user/hand/left/input/select/click"}}));
    ASSERT_XR_SUCCESS(xrDestroyAction(fire));
    const XrAction again = actions_->create(set, "fire", boolean);
    EXPECT_NE(again, fire);
    ASSERT_XR_SUCCESS(xrDestroyActionSet(set));
    actions_->create_set("set");
}

TEST_F(Bindings, SetsCanBeAttachedToTheNextSession) {
    const XrActionSet set = actions_->create_set("set");
    ASSERT_XR_SUCCESS(actions_->attach({set}));
    EXPECT_EQ(actions_->attach({set}), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
    ASSERT_XR_SUCCESS(xrDestroySession(actions_->client->session));
    actions_->client->create_headless_session();
    EXPECT_EQ(actions_->attach({set}), XR_SUCCESS);
}

}  // namespace
}  // namespace foveray::simulator_tests
