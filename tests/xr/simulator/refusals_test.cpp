// Arguments that the specification forbids, and the error it wants: names, paths, systems, spaces, haptics.
#include <cmath>
#include <cstring>

#include "tests/xr/simulator/action_client.h"

namespace foveray::simulator_tests {
namespace {

XrInstanceCreateInfo instance_info() {
    XrInstanceCreateInfo info{};
    info.type = XR_TYPE_INSTANCE_CREATE_INFO;
    std::strcpy(info.applicationInfo.applicationName, "refusals");
    info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
    return info;
}

TEST(InstanceRefusals, EachHasItsError) {
    set_environment({});
    const auto expect = [](XrResult result, auto change, const char* what) {
        XrInstanceCreateInfo info = instance_info();
        change(info);
        XrInstance instance = XR_NULL_HANDLE;
        EXPECT_EQ(xrCreateInstance(&info, &instance), result) << what;
        if (instance) xrDestroyInstance(instance);
    };
    expect(
        XR_ERROR_VALIDATION_FAILURE, [](auto& i) { i.createFlags = 0x42; }, "flags");
    expect(
        XR_ERROR_NAME_INVALID,
        [](auto& i) { std::memset(i.applicationInfo.applicationName, 'a', XR_MAX_APPLICATION_NAME_SIZE); },
        "a name without end");
    expect(
        XR_ERROR_NAME_INVALID,
        [](auto& i) { std::memset(i.applicationInfo.engineName, 'e', XR_MAX_ENGINE_NAME_SIZE); },
        "an engine's name without end");
    for (const XrVersion version : {XrVersion{0}, XrVersion{1}, XrVersion{XR_MAKE_VERSION(100, 0, 0)}}) {
        expect(
            XR_ERROR_API_VERSION_UNSUPPORTED, [&](auto& i) { i.applicationInfo.apiVersion = version; },
            "version");
    }
    const char* const misspelt = "xr_mnd_HEADLESS";
    expect(
        XR_ERROR_EXTENSION_NOT_PRESENT,
        [&](auto& i) { i.enabledExtensionCount = 1, i.enabledExtensionNames = &misspelt; }, "case");
    EXPECT_EQ(xrCreateInstance(nullptr, nullptr), XR_ERROR_VALIDATION_FAILURE);
    expect(
        XR_SUCCESS, [](auto& i) { std::strcpy(i.applicationInfo.engineName, "π"); }, "UTF-8");
    for (int i = 0; i < 20; ++i)
        expect(
            XR_SUCCESS, [](auto&) {}, "again and again");
}

class Refusals : public testing::Test {
  protected:
    Refusals() {
        set_environment({});
        auto client = std::make_unique<SimulatorClient>(headless_extensions);
        client->create_headless_session();
        actions_ = std::make_unique<ActionClient>(std::move(client));
        instance_ = actions_->client->instance;
        session_ = actions_->client->session;
    }

    std::unique_ptr<ActionClient> actions_;
    XrInstance instance_ = XR_NULL_HANDLE;
    XrSession session_ = XR_NULL_HANDLE;
};

TEST_F(Refusals, Systems) {
    XrSystemId system = XR_NULL_SYSTEM_ID;
    for (const auto form : {XR_FORM_FACTOR_HANDHELD_DISPLAY, XR_FORM_FACTOR_MAX_ENUM}) {
        const XrSystemGetInfo info{XR_TYPE_SYSTEM_GET_INFO, nullptr, form};
        EXPECT_EQ(xrGetSystem(instance_, &info, &system), XR_ERROR_FORM_FACTOR_UNSUPPORTED);
    }
    std::uint32_t count = 0;
    const auto stereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    for (const XrSystemId wrong : {XrSystemId{XR_NULL_SYSTEM_ID}, XrSystemId{0x1234}}) {
        EXPECT_EQ(xrEnumerateViewConfigurations(instance_, wrong, 0, &count, nullptr),
                  XR_ERROR_SYSTEM_INVALID);
        EXPECT_EQ(xrEnumerateEnvironmentBlendModes(instance_, wrong, stereo, 0, &count, nullptr),
                  XR_ERROR_SYSTEM_INVALID);
    }
    for (const auto type : {XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO, XR_VIEW_CONFIGURATION_TYPE_MAX_ENUM}) {
        XrViewConfigurationProperties properties{
            XR_TYPE_VIEW_CONFIGURATION_PROPERTIES, nullptr, {}, XR_FALSE};
        EXPECT_EQ(xrGetViewConfigurationProperties(instance_, 1, type, &properties),
                  XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
        EXPECT_EQ(xrEnumerateViewConfigurationViews(instance_, 1, type, 0, &count, nullptr),
                  XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
        EXPECT_EQ(xrEnumerateEnvironmentBlendModes(instance_, 1, type, 0, &count, nullptr),
                  XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
    }
}

TEST_F(Refusals, EyeGazeIsPromisedOnlyToThoseWhoAskForIt) {
    actions_.reset();
    for (const bool enabled : {false, true}) {
        SimulatorClient client(enabled ? headless_extensions
                                       : std::vector<const char*>{XR_MND_HEADLESS_EXTENSION_NAME});
        XrSystemEyeGazeInteractionPropertiesEXT gaze{XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT,
                                                     nullptr, XR_FALSE};
        XrSystemProperties properties{};
        properties.type = XR_TYPE_SYSTEM_PROPERTIES;
        properties.next = &gaze;
        ASSERT_XR_SUCCESS(xrGetSystemProperties(client.instance, 1, &properties));
        EXPECT_EQ(bool(gaze.supportsEyeGazeInteraction), enabled);
    }
}

TEST_F(Refusals, Paths) {
    const std::string longest = "/" + std::string(XR_MAX_PATH_LENGTH - 2, 'a');
    XrPath path = XR_NULL_PATH;
    for (const std::string& text :
         {std::string("/foo"), std::string("/.f"), std::string("/f."), std::string("/a./.a/.a./a.a"),
          std::string("/.....ok"), std::string("/a_9-z."), std::string("/-/_"), longest}) {
        EXPECT_EQ(xrStringToPath(instance_, text.c_str(), &path), XR_SUCCESS) << text;
    }
    for (const std::string& text :
         {std::string(""), std::string("/"), std::string("//"), std::string("/end/"), std::string("/a//a"),
          std::string("\\a"), std::string("/ "), std::string("/wha?"), std::string("/aaA"),
          std::string("foo"), std::string("/../foo"), std::string("/."), std::string("/../.."),
          longest + "a"}) {
        EXPECT_EQ(xrStringToPath(instance_, text.c_str(), &path), XR_ERROR_PATH_FORMAT_INVALID) << text;
    }
    EXPECT_EQ(xrStringToPath(instance_, nullptr, &path), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_EQ(xrStringToPath(instance_, "/a", nullptr), XR_ERROR_VALIDATION_FAILURE);
    for (const XrPath garbage : {XrPath{XR_NULL_PATH}, XrPath{0x1234}, ~XrPath{0}}) {
        std::uint32_t count = 0;
        EXPECT_EQ(xrPathToString(instance_, garbage, 0, &count, nullptr), XR_ERROR_PATH_INVALID);
    }
}

TEST_F(Refusals, Names) {
    const XrActionSet set = actions_->create_set("set");
    struct Case {
        const char *name, *localized;
        XrResult result;
    };
    static const std::string endless(200, 'a');
    for (const Case& c : {Case{"", "x", XR_ERROR_NAME_INVALID},
                          {"x", "", XR_ERROR_LOCALIZED_NAME_INVALID},
                          {"INVALID PATH COMPONENT", "x", XR_ERROR_PATH_FORMAT_INVALID},
                          {"a/b", "x", XR_ERROR_PATH_FORMAT_INVALID},
                          {endless.c_str(), "x", XR_ERROR_NAME_INVALID},
                          {"x", endless.c_str(), XR_ERROR_LOCALIZED_NAME_INVALID}}) {
        XrActionSetCreateInfo set_info{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "", "", 0};
        std::memcpy(set_info.actionSetName, c.name,
                    std::min(std::strlen(c.name) + 1, sizeof set_info.actionSetName));
        std::memcpy(set_info.localizedActionSetName, c.localized,
                    std::min(std::strlen(c.localized) + 1, sizeof set_info.localizedActionSetName));
        XrActionSet ignored_set = XR_NULL_HANDLE;
        EXPECT_EQ(xrCreateActionSet(instance_, &set_info, &ignored_set), c.result) << c.name;
        XrActionCreateInfo info{};
        info.type = XR_TYPE_ACTION_CREATE_INFO;
        info.actionType = XR_ACTION_TYPE_BOOLEAN_INPUT;
        std::memcpy(info.actionName, c.name, std::min(std::strlen(c.name) + 1, sizeof info.actionName));
        std::memcpy(info.localizedActionName, c.localized,
                    std::min(std::strlen(c.localized) + 1, sizeof info.localizedActionName));
        XrAction ignored = XR_NULL_HANDLE;
        EXPECT_EQ(xrCreateAction(set, &info, &ignored), c.result) << c.name;
    }
}

TEST_F(Refusals, SubactionPaths) {
    const XrActionSet set = actions_->create_set("set");
    XrActionCreateInfo info{};
    info.type = XR_TYPE_ACTION_CREATE_INFO;
    std::strcpy(info.actionName, "action");
    std::strcpy(info.localizedActionName, "action");
    info.actionType = XR_ACTION_TYPE_FLOAT_INPUT;
    const auto create = [&](const std::vector<XrPath>& paths) {
        info.countSubactionPaths = static_cast<std::uint32_t>(paths.size());
        info.subactionPaths = paths.data();
        XrAction action = XR_NULL_HANDLE;
        return xrCreateAction(set, &info, &action);
    };
    const auto path = [&](const char* text) { return actions_->client->path(text); };
    EXPECT_EQ(create({path("/user/head"), path("/user/head")}), XR_ERROR_PATH_UNSUPPORTED) << "twice";
    EXPECT_EQ(create({path("/user/invalid")}), XR_ERROR_PATH_UNSUPPORTED);
    EXPECT_EQ(create({XR_NULL_PATH}), XR_ERROR_PATH_INVALID);
    EXPECT_EQ(create({0x1234}), XR_ERROR_PATH_INVALID);
    EXPECT_EQ(create({path("/user/hand/left"), path("/user/head"), path("/user/gamepad"),
                      path("/user/treadmill")}),
              XR_SUCCESS);
    info.actionType = XR_ACTION_TYPE_MAX_ENUM;
    EXPECT_EQ(create({}), XR_ERROR_VALIDATION_FAILURE);
}

TEST_F(Refusals, ActionQueries) {
    const XrActionSet set = actions_->create_set("set"), loose = actions_->create_set("loose");
    const XrAction pull = actions_->create(set, "pull", XR_ACTION_TYPE_FLOAT_INPUT),
                   buzz = actions_->create(set, "buzz", XR_ACTION_TYPE_VIBRATION_OUTPUT);
    XrActionStateFloat state{};
    state.type = XR_TYPE_ACTION_STATE_FLOAT;
    const auto get = [&](XrAction action, XrPath path) {
        const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action, path};
        return xrGetActionStateFloat(session_, &info, &state);
    };
    const auto stop = [&](XrAction action, XrPath path) {
        const XrHapticActionInfo info{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, action, path};
        return xrStopHapticFeedback(session_, &info);
    };
    XrInteractionProfileState profile{XR_TYPE_INTERACTION_PROFILE_STATE, nullptr, 0};
    const auto get_profile = [&](XrPath path) {
        return xrGetCurrentInteractionProfile(session_, path, &profile);
    };
    EXPECT_EQ(get(pull, XR_NULL_PATH), XR_ERROR_ACTIONSET_NOT_ATTACHED);
    EXPECT_EQ(stop(buzz, XR_NULL_PATH), XR_ERROR_ACTIONSET_NOT_ATTACHED);
    EXPECT_EQ(get_profile(actions_->hands[0]), XR_ERROR_ACTIONSET_NOT_ATTACHED);
    EXPECT_EQ(actions_->sync({{set, XR_NULL_PATH}}), XR_ERROR_ACTIONSET_NOT_ATTACHED);
    EXPECT_EQ(actions_->sync({}), XR_SESSION_NOT_FOCUSED) << "nothing to synchronise is no error";
    EXPECT_EQ(actions_->attach({}), XR_ERROR_VALIDATION_FAILURE);
    ASSERT_XR_SUCCESS(actions_->attach({set}));
    EXPECT_EQ(actions_->sync({{set, XR_NULL_PATH}, {loose, XR_NULL_PATH}}), XR_ERROR_ACTIONSET_NOT_ATTACHED);
    EXPECT_EQ(actions_->sync({{set, 0x1234}}), XR_ERROR_PATH_INVALID);
    EXPECT_EQ(actions_->sync({{set, actions_->client->path("/user/gamepad")}}), XR_ERROR_PATH_UNSUPPORTED);
    EXPECT_EQ(get(pull, 0x1234), XR_ERROR_PATH_INVALID);
    EXPECT_EQ(get(pull, actions_->client->path("/user/gamepad")), XR_ERROR_PATH_UNSUPPORTED);
    EXPECT_EQ(get(buzz, XR_NULL_PATH), XR_ERROR_ACTION_TYPE_MISMATCH);
    EXPECT_EQ(stop(pull, XR_NULL_PATH), XR_ERROR_ACTION_TYPE_MISMATCH);
    EXPECT_EQ(stop(buzz, 0x1234), XR_ERROR_PATH_INVALID);
    EXPECT_EQ(stop(buzz, XR_NULL_PATH), XR_SESSION_NOT_FOCUSED);
    EXPECT_EQ(get_profile(XR_NULL_PATH), XR_ERROR_PATH_INVALID);
    EXPECT_EQ(get_profile(0x1234), XR_ERROR_PATH_INVALID);
    EXPECT_EQ(get_profile(actions_->client->path("/invalid/top/level/path")), XR_ERROR_PATH_UNSUPPORTED);
    state.currentState = 5.0f, state.isActive = XR_TRUE, state.lastChangeTime = 7;
    EXPECT_EQ(get(pull, XR_NULL_PATH), XR_SUCCESS);
    EXPECT_TRUE(!state.isActive && state.currentState == 0.0f && state.lastChangeTime == 0)
        << "what an inactive action had is overwritten";

    std::uint32_t count = 0;
    const auto get_name = [&](XrPath path, XrInputSourceLocalizedNameFlags which) {
        const XrInputSourceLocalizedNameGetInfo info{XR_TYPE_INPUT_SOURCE_LOCALIZED_NAME_GET_INFO, nullptr,
                                                     path, which};
        return xrGetInputSourceLocalizedName(session_, &info, 0, &count, nullptr);
    };
    EXPECT_EQ(get_name(actions_->hands[0], 0), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_EQ(get_name(actions_->hands[0], 8), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_EQ(get_name(XR_NULL_PATH, 1), XR_ERROR_PATH_INVALID);
    EXPECT_EQ(get_name(actions_->hands[0], 1), XR_ERROR_PATH_UNSUPPORTED);
}

TEST_F(Refusals, SpacesAndTimes) {
    const XrSpace space = actions_->client->reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY, nullptr, 0, {}, {}};
    XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, &velocity, 0, {}};
    for (const XrTime time : {XrTime{0}, XrTime{-1}, XrTime{-42}, INT64_MIN})
        EXPECT_EQ(xrLocateSpace(space, space, time, &location), XR_ERROR_TIME_INVALID) << time;
    for (const XrTime time : {XrTime{1}, XrTime{1'000'000'000}, INT64_MAX})
        EXPECT_EQ(xrLocateSpace(space, space, time, &location), XR_SUCCESS) << time;
    XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO,
                                    nullptr,
                                    XR_REFERENCE_SPACE_TYPE_MAX_ENUM,
                                    {{0, 0, 0, 1}, {0, 0, 0}}};
    XrSpace made = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateReferenceSpace(session_, &info, &made), XR_ERROR_REFERENCE_SPACE_UNSUPPORTED);
    info.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_STAGE;
    for (const float w : {0.0f, 0.98f, 1.02f, NAN, INFINITY}) {
        info.poseInReferenceSpace.orientation.w = w;
        EXPECT_EQ(xrCreateReferenceSpace(session_, &info, &made), XR_ERROR_POSE_INVALID) << w;
    }
    XrExtent2Df bounds{-1.0f, -1.0f};
    EXPECT_EQ(xrGetReferenceSpaceBoundsRect(session_, XR_REFERENCE_SPACE_TYPE_MAX_ENUM, &bounds),
              XR_ERROR_REFERENCE_SPACE_UNSUPPORTED);
    EXPECT_EQ(xrGetReferenceSpaceBoundsRect(session_, XR_REFERENCE_SPACE_TYPE_VIEW, &bounds),
              XR_SPACE_BOUNDS_UNAVAILABLE);
    EXPECT_EQ(bounds.width, 0.0f);
    EXPECT_EQ(bounds.height, 0.0f);
    const XrAction pull = actions_->create(actions_->create_set("set"), "pull", XR_ACTION_TYPE_FLOAT_INPUT);
    const XrActionSpaceCreateInfo action_info{
        XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, pull, XR_NULL_PATH, {{0, 0, 0, 1}, {0, 0, 0}}};
    EXPECT_EQ(xrCreateActionSpace(session_, &action_info, &made), XR_ERROR_ACTION_TYPE_MISMATCH);
}

}  // namespace
}  // namespace foveray::simulator_tests
