// Structure chains: unknown structures are ignored, a wrong type or no structure is refused; texts and
// arrays are asked for twice.
#include <cstring>
#include <functional>

#include "tests/xr/simulator/action_client.h"

namespace foveray::simulator_tests {
namespace {

XrBaseOutStructure unknown_structure{static_cast<XrStructureType>(0x7000'0000), nullptr};

template <typename Structure>
void chain_unknown(Structure& structure) {
    structure.next = &unknown_structure;
}

class Structures : public testing::Test {
  protected:
    Structures() {
        set_environment({});
        auto client = std::make_unique<SimulatorClient>(headless_extensions);
        client->create_headless_session();
        client->begin_session(stereo);
        actions_ = std::make_unique<ActionClient>(std::move(client));
        client_ = actions_->client.get();
        instance_ = client_->instance;
        session_ = client_->session;
        space_ = client_->reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
        set_ = actions_->create_set("set");
        for (const auto& [type, name] : {std::pair{XR_ACTION_TYPE_BOOLEAN_INPUT, "boolean"},
                                         {XR_ACTION_TYPE_FLOAT_INPUT, "number"},
                                         {XR_ACTION_TYPE_VECTOR2F_INPUT, "vector"},
                                         {XR_ACTION_TYPE_POSE_INPUT, "pose"},
                                         {XR_ACTION_TYPE_VIBRATION_OUTPUT, "haptic"}}) {
            made_[type] = actions_->create(set_, name, type);
        }
    }

    /// `call` succeeds with the structure, also with an unknown one behind it, and refuses another type and
    /// nullptr (where it is not optional).
    template <typename Structure>
    void check(const char* what, const Structure& structure, std::function<XrResult(Structure*)> call,
               bool optional = false) {
        Structure plain = structure;
        EXPECT_GE(call(&plain), 0) << what;
        Structure chained = structure;
        chain_unknown(chained);
        EXPECT_GE(call(&chained), 0) << what << " with an unknown structure";
        Structure wrong = structure;
        wrong.type = XR_TYPE_UNKNOWN;
        EXPECT_EQ(call(&wrong), XR_ERROR_VALIDATION_FAILURE) << what << " with a wrong type";
        if (optional) {
            EXPECT_GE(call(nullptr), 0) << what << " left out";
        } else {
            EXPECT_EQ(call(nullptr), XR_ERROR_VALIDATION_FAILURE) << what << " missing";
        }
    }

    static constexpr auto stereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    std::unique_ptr<ActionClient> actions_;
    SimulatorClient* client_ = nullptr;
    XrInstance instance_ = XR_NULL_HANDLE;
    XrSession session_ = XR_NULL_HANDLE;
    XrSpace space_ = XR_NULL_HANDLE;
    XrActionSet set_ = XR_NULL_HANDLE;
    std::map<XrActionType, XrAction> made_;
};

TEST_F(Structures, OfInstancesAndSystems) {
    XrInstanceProperties properties{};
    properties.type = XR_TYPE_INSTANCE_PROPERTIES;
    check<XrInstanceProperties>("instance properties", properties,
                                [&](auto* s) { return xrGetInstanceProperties(instance_, s); });
    check<XrSystemGetInfo>("system", {XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY},
                           [&](auto* s) {
                               XrSystemId id = XR_NULL_SYSTEM_ID;
                               return xrGetSystem(instance_, s, &id);
                           });
    XrSystemProperties system{};
    system.type = XR_TYPE_SYSTEM_PROPERTIES;
    check<XrSystemProperties>("system properties", system,
                              [&](auto* s) { return xrGetSystemProperties(instance_, 1, s); });
    check<XrViewConfigurationProperties>(
        "view configuration", {XR_TYPE_VIEW_CONFIGURATION_PROPERTIES, nullptr, {}, XR_FALSE},
        [&](auto* s) { return xrGetViewConfigurationProperties(instance_, 1, stereo, s); });
    XrEventDataBuffer event{};
    event.type = XR_TYPE_EVENT_DATA_BUFFER;
    check<XrEventDataBuffer>("event", event, [&](auto* s) { return xrPollEvent(instance_, s); });
}

TEST_F(Structures, OfSpacesAndViews) {
    check<XrReferenceSpaceCreateInfo>("reference space",
                                      {XR_TYPE_REFERENCE_SPACE_CREATE_INFO,
                                       nullptr,
                                       XR_REFERENCE_SPACE_TYPE_VIEW,
                                       {{0, 0, 0, 1}, {0, 0, 0}}},
                                      [&](auto* s) {
                                          XrSpace space = XR_NULL_HANDLE;
                                          return xrCreateReferenceSpace(session_, s, &space);
                                      });
    check<XrActionSpaceCreateInfo>("action space",
                                   {XR_TYPE_ACTION_SPACE_CREATE_INFO,
                                    nullptr,
                                    made_[XR_ACTION_TYPE_POSE_INPUT],
                                    XR_NULL_PATH,
                                    {{0, 0, 0, 1}, {0, 0, 0}}},
                                   [&](auto* s) {
                                       XrSpace space = XR_NULL_HANDLE;
                                       return xrCreateActionSpace(session_, s, &space);
                                   });
    check<XrSpaceLocation>("location", {XR_TYPE_SPACE_LOCATION, nullptr, 0, {}},
                           [&](auto* s) { return xrLocateSpace(space_, space_, 1, s); });
    XrView view[2]{{XR_TYPE_VIEW, nullptr, {}, {}}, {XR_TYPE_VIEW, nullptr, {}, {}}};
    XrViewState state{XR_TYPE_VIEW_STATE, nullptr, 0};
    const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, stereo, 1, space_};
    std::uint32_t count = 0;
    check<XrViewLocateInfo>("views", info,
                            [&](auto* s) { return xrLocateViews(session_, s, &state, 2, &count, view); });
    check<XrViewState>("view state", state,
                       [&](auto* s) { return xrLocateViews(session_, &info, s, 2, &count, view); });
    view[1].type = XR_TYPE_UNKNOWN;
    EXPECT_EQ(xrLocateViews(session_, &info, &state, 2, &count, view), XR_ERROR_VALIDATION_FAILURE);
    XrViewConfigurationView size[2]{};
    for (auto& s : size) s.type = XR_TYPE_VIEW_CONFIGURATION_VIEW, chain_unknown(s);
    EXPECT_EQ(xrEnumerateViewConfigurationViews(instance_, 1, stereo, 2, &count, size), XR_SUCCESS);
    size[0].type = XR_TYPE_UNKNOWN;
    EXPECT_EQ(xrEnumerateViewConfigurationViews(instance_, 1, stereo, 2, &count, size),
              XR_ERROR_VALIDATION_FAILURE);
}

TEST_F(Structures, OfFrames) {
    XrFrameState state{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
    const auto wait = [&] { return xrWaitFrame(session_, nullptr, &state); };
    const auto begin = [&] { return xrBeginFrame(session_, nullptr); };
    check<XrFrameWaitInfo>(
        "wait", {XR_TYPE_FRAME_WAIT_INFO, nullptr},
        [&](auto* s) {
            const XrResult result = xrWaitFrame(session_, s, &state);
            if (XR_SUCCEEDED(result)) begin();
            return result;
        },
        true);
    check<XrFrameState>("frame state", state, [&](auto* s) {
        const XrResult result = xrWaitFrame(session_, nullptr, s);
        if (XR_SUCCEEDED(result)) begin();
        return result;
    });
    EXPECT_EQ(wait(), XR_SUCCESS);
    check<XrFrameBeginInfo>(
        "begin", {XR_TYPE_FRAME_BEGIN_INFO, nullptr},
        [&](auto* s) {
            const XrResult result = xrBeginFrame(session_, s);
            if (XR_SUCCEEDED(result)) wait();
            return result;
        },
        true);
    EXPECT_GE(begin(), 0);
    check<XrFrameEndInfo>("end",
                          {XR_TYPE_FRAME_END_INFO, nullptr, state.predictedDisplayTime,
                           XR_ENVIRONMENT_BLEND_MODE_OPAQUE, 0, nullptr},
                          [&](auto* s) {
                              const XrResult result = xrEndFrame(session_, s);
                              if (XR_SUCCEEDED(result)) wait(), begin();
                              return result;
                          });
}

TEST_F(Structures, OfActions) {
    int names = 0;
    XrActionSetCreateInfo set_info{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "", "", 0};
    check<XrActionSetCreateInfo>("action set", set_info, [&](auto* s) {
        if (s) std::strcpy(s->actionSetName, ("s" + std::to_string(++names)).c_str());
        if (s) std::strcpy(s->localizedActionSetName, s->actionSetName);
        XrActionSet set = XR_NULL_HANDLE;
        return xrCreateActionSet(instance_, s, &set);
    });
    XrActionCreateInfo action_info{};
    action_info.type = XR_TYPE_ACTION_CREATE_INFO;
    action_info.actionType = XR_ACTION_TYPE_BOOLEAN_INPUT;
    check<XrActionCreateInfo>("action", action_info, [&](auto* s) {
        if (s) std::strcpy(s->actionName, ("a" + std::to_string(++names)).c_str());
        if (s) std::strcpy(s->localizedActionName, s->actionName);
        XrAction action = XR_NULL_HANDLE;
        return xrCreateAction(set_, s, &action);
    });
    const XrActionSuggestedBinding binding{made_[XR_ACTION_TYPE_BOOLEAN_INPUT],
                                           client_->path("/user/hand/left/input/select/click")};
    check<XrInteractionProfileSuggestedBinding>(
        "suggestion",
        {XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr,
         client_->path("/interaction_profiles/khr/simple_controller"), 1, &binding},
        [&](auto* s) { return xrSuggestInteractionProfileBindings(instance_, s); });
    XrSessionActionSetsAttachInfo attach{XR_TYPE_UNKNOWN, nullptr, 1, &set_};
    EXPECT_EQ(xrAttachSessionActionSets(session_, &attach), XR_ERROR_VALIDATION_FAILURE);
    attach.type = XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO;
    chain_unknown(attach);
    ASSERT_XR_SUCCESS(xrAttachSessionActionSets(session_, &attach));
    const XrActiveActionSet active{set_, XR_NULL_PATH};
    check<XrActionsSyncInfo>("sync", {XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active},
                             [&](auto* s) { return xrSyncActions(session_, s); });
    check<XrInteractionProfileState>(
        "profile", {XR_TYPE_INTERACTION_PROFILE_STATE, nullptr, 0},
        [&](auto* s) { return xrGetCurrentInteractionProfile(session_, actions_->hands[0], s); });

    const auto check_state = [&](auto state, XrActionType type, auto get, const char* what) {
        const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, made_[type], XR_NULL_PATH};
        check<decltype(state)>(what, state, [&](auto* s) { return get(session_, &info, s); });
        check<XrActionStateGetInfo>(what, info, [&](auto* s) { return get(session_, s, &state); });
    };
    check_state(XrActionStateBoolean{XR_TYPE_ACTION_STATE_BOOLEAN, nullptr, 0, 0, 0, 0},
                XR_ACTION_TYPE_BOOLEAN_INPUT, xrGetActionStateBoolean, "boolean state");
    check_state(XrActionStateFloat{XR_TYPE_ACTION_STATE_FLOAT, nullptr, 0, 0, 0, 0},
                XR_ACTION_TYPE_FLOAT_INPUT, xrGetActionStateFloat, "float state");
    check_state(XrActionStateVector2f{XR_TYPE_ACTION_STATE_VECTOR2F, nullptr, {}, 0, 0, 0},
                XR_ACTION_TYPE_VECTOR2F_INPUT, xrGetActionStateVector2f, "vector state");
    check_state(XrActionStatePose{XR_TYPE_ACTION_STATE_POSE, nullptr, 0}, XR_ACTION_TYPE_POSE_INPUT,
                xrGetActionStatePose, "pose state");

    const XrHapticActionInfo haptic{XR_TYPE_HAPTIC_ACTION_INFO, nullptr,
                                    made_[XR_ACTION_TYPE_VIBRATION_OUTPUT], XR_NULL_PATH};
    check<XrHapticActionInfo>("haptic", haptic, [&](auto* s) { return xrStopHapticFeedback(session_, s); });
    check<XrHapticVibration>(
        "vibration",
        {XR_TYPE_HAPTIC_VIBRATION, nullptr, XR_MIN_HAPTIC_DURATION, XR_FREQUENCY_UNSPECIFIED, 1.0f},
        [&](auto* s) {
            return xrApplyHapticFeedback(session_, &haptic, reinterpret_cast<const XrHapticBaseHeader*>(s));
        });
    std::uint32_t count = 0;
    check<XrBoundSourcesForActionEnumerateInfo>(
        "bound sources",
        {XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO, nullptr, made_[XR_ACTION_TYPE_BOOLEAN_INPUT]},
        [&](auto* s) { return xrEnumerateBoundSourcesForAction(session_, s, 0, &count, nullptr); });
}

/// The two-call idiom: `call(capacity, count)` for a list of some elements.
void check_two_calls(const char* what,
                     const std::function<XrResult(std::uint32_t, std::uint32_t*, bool has_array)>& call) {
    std::uint32_t count = 0, again = 0;
    ASSERT_EQ(call(0, &count, false), XR_SUCCESS) << what;
    ASSERT_GT(count, 0u) << what;
    EXPECT_EQ(call(0, nullptr, false), XR_ERROR_VALIDATION_FAILURE) << what << " without a count";
    if (count > 1) {
        EXPECT_EQ(call(count - 1, &again, true), XR_ERROR_SIZE_INSUFFICIENT) << what;
        EXPECT_EQ(again, count) << what << ": the size that is needed";
    }
    EXPECT_EQ(call(count, &again, false), XR_ERROR_VALIDATION_FAILURE) << what << " without an array";
    again = 0;
    EXPECT_EQ(call(count + 5, &again, true), XR_SUCCESS) << what << " with room to spare";
    EXPECT_EQ(again, count) << what;
}

TEST_F(Structures, ListsAndTextsAreAskedForTwice) {
    XrViewConfigurationType types[8];
    check_two_calls("view configurations", [&](std::uint32_t capacity, std::uint32_t* count, bool array) {
        return xrEnumerateViewConfigurations(instance_, 1, capacity, count, array ? types : nullptr);
    });
    XrViewConfigurationView views[8]{};
    for (auto& view : views) view.type = XR_TYPE_VIEW_CONFIGURATION_VIEW;
    check_two_calls("views", [&](std::uint32_t capacity, std::uint32_t* count, bool array) {
        return xrEnumerateViewConfigurationViews(instance_, 1, stereo, capacity, count,
                                                 array ? views : nullptr);
    });
    XrEnvironmentBlendMode modes[8];
    check_two_calls("blend modes", [&](std::uint32_t capacity, std::uint32_t* count, bool array) {
        return xrEnumerateEnvironmentBlendModes(instance_, 1, stereo, capacity, count,
                                                array ? modes : nullptr);
    });
    XrReferenceSpaceType spaces[16];
    check_two_calls("reference spaces", [&](std::uint32_t capacity, std::uint32_t* count, bool array) {
        return xrEnumerateReferenceSpaces(session_, capacity, count, array ? spaces : nullptr);
    });
    char text[64];
    const XrPath path = actions_->hands[0];
    check_two_calls("path", [&](std::uint32_t capacity, std::uint32_t* count, bool array) {
        return xrPathToString(instance_, path, capacity, count, array ? text : nullptr);
    });
    XrExtensionProperties extensions[64]{};
    for (auto& extension : extensions) extension.type = XR_TYPE_EXTENSION_PROPERTIES;
    check_two_calls("extensions", [&](std::uint32_t capacity, std::uint32_t* count, bool array) {
        return xrEnumerateInstanceExtensionProperties(nullptr, capacity, count, array ? extensions : nullptr);
    });
}

}  // namespace
}  // namespace foveray::simulator_tests
