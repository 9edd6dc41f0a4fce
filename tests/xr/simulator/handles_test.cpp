// Handles that are garbage, destroyed, of another type or of another instance, in every function.
#include <cstring>
#include <functional>
#include <string_view>
#include <typeindex>

#include <gtest/gtest.h>

#include "tests/xr/simulator/direct_runtime.h"
#include "tests/xr/simulator/simulator_client.h"
#include "xr/simulator/api/functions.h"

namespace foveray::simulator_tests {
namespace {

struct HandleFunction {
    const char* name;
    std::type_index type;
    std::function<XrResult(std::uint64_t)> call;  // with that handle and nothing else
};

template <typename T>
constexpr bool is_handle = std::is_pointer_v<T> && !std::is_const_v<std::remove_pointer_t<T>>;

/// Functions without a handle are left out.
template <typename First, typename... Rest>
void add(std::vector<HandleFunction>& list, const char* name, XrResult (*function)(First, Rest...)) {
    if constexpr (is_handle<First>) {
        EXPECT_NE(function, nullptr) << name;
        if (!function) return;
        list.push_back({name, typeid(First), [function](std::uint64_t handle) {
                            return function(reinterpret_cast<First>(handle), Rest{}...);
                        }});
    }
}

struct TypedHandle {
    std::uint64_t value;
    std::type_index type;
};

class Handles : public testing::Test {
  protected:
    Handles() {
        set_environment({{"TIME", "real"}});
        first_ = make();
    }

    struct Objects {
        XrInstance instance = XR_NULL_HANDLE;
        XrSession session = XR_NULL_HANDLE;
        XrSpace space = XR_NULL_HANDLE;
        XrActionSet set = XR_NULL_HANDLE;
        XrAction action = XR_NULL_HANDLE, buzz = XR_NULL_HANDLE;
        XrHandTrackerEXT tracker = XR_NULL_HANDLE;
        XrDebugUtilsMessengerEXT messenger = XR_NULL_HANDLE;

        std::vector<TypedHandle> all() const {
            std::vector<TypedHandle> list;
            const auto add = [&](auto handle) {
                list.push_back({reinterpret_cast<std::uint64_t>(handle), typeid(handle)});
            };
            add(instance), add(session), add(space), add(set), add(action), add(tracker), add(messenger);
            return list;
        }
    };

    template <typename Function>
    Function load(const char* name) const {
        return runtime_.load<Function>(first_.instance, name);
    }

    XrAction make_action(XrActionSet set, const char* name, XrActionType type) const {
        XrActionCreateInfo info{};
        info.type = XR_TYPE_ACTION_CREATE_INFO;
        std::strcpy(info.actionName, name);
        std::strcpy(info.localizedActionName, name);
        info.actionType = type;
        XrAction action = XR_NULL_HANDLE;
        EXPECT_EQ(load<PFN_xrCreateAction>("xrCreateAction")(set, &info, &action), XR_SUCCESS);
        return action;
    }

    /// An instance with one object of each type that needs no graphics.
    Objects make() {
        Objects made;
        std::vector<const char*> extensions{XR_MND_HEADLESS_EXTENSION_NAME,
                                            XR_EXT_HAND_TRACKING_EXTENSION_NAME,
                                            XR_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                            XR_EXT_CONFORMANCE_AUTOMATION_EXTENSION_NAME,
                                            XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME,
                                            XR_KHR_VISIBILITY_MASK_EXTENSION_NAME,
                                            XR_KHR_VULKAN_ENABLE_EXTENSION_NAME,
                                            XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME};
        if (simulator::has_openxr_1_1) extensions.push_back(XR_KHR_LOCATE_SPACES_EXTENSION_NAME);
        made.instance = runtime_.create_instance(extensions);
        if (!first_.instance) first_.instance = made.instance;
        const XrSessionCreateInfo session_info{XR_TYPE_SESSION_CREATE_INFO, nullptr, 0, 1};
        EXPECT_EQ(load<PFN_xrCreateSession>("xrCreateSession")(made.instance, &session_info, &made.session),
                  XR_SUCCESS);
        const XrReferenceSpaceCreateInfo space_info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO,
                                                    nullptr,
                                                    XR_REFERENCE_SPACE_TYPE_LOCAL,
                                                    {{0, 0, 0, 1}, {0, 0, 0}}};
        EXPECT_EQ(load<PFN_xrCreateReferenceSpace>("xrCreateReferenceSpace")(made.session, &space_info,
                                                                             &made.space),
                  XR_SUCCESS);
        const XrActionSetCreateInfo set_info{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "set", "Set", 0};
        EXPECT_EQ(load<PFN_xrCreateActionSet>("xrCreateActionSet")(made.instance, &set_info, &made.set),
                  XR_SUCCESS);
        made.action = make_action(made.set, "move", XR_ACTION_TYPE_POSE_INPUT);
        made.buzz = make_action(made.set, "buzz", XR_ACTION_TYPE_VIBRATION_OUTPUT);
        const XrHandTrackerCreateInfoEXT hand_info{XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT, nullptr,
                                                   XR_HAND_LEFT_EXT, XR_HAND_JOINT_SET_DEFAULT_EXT};
        EXPECT_EQ(load<PFN_xrCreateHandTrackerEXT>("xrCreateHandTrackerEXT")(made.session, &hand_info,
                                                                             &made.tracker),
                  XR_SUCCESS);
        const XrDebugUtilsMessengerCreateInfoEXT messenger_info{
            XR_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
            nullptr,
            XR_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
            XR_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
            [](XrDebugUtilsMessageSeverityFlagsEXT, XrDebugUtilsMessageTypeFlagsEXT,
               const XrDebugUtilsMessengerCallbackDataEXT*, void*) -> XrBool32 { return XR_FALSE; },
            nullptr};
        EXPECT_EQ(load<PFN_xrCreateDebugUtilsMessengerEXT>("xrCreateDebugUtilsMessengerEXT")(
                      made.instance, &messenger_info, &made.messenger),
                  XR_SUCCESS);
        return made;
    }

    /// All that an instance of 1.0 has, but for the one that takes no instance too.
    std::vector<HandleFunction> functions() const {
        using simulator::openxr_1_1;
        std::vector<HandleFunction> list;
        const auto has = [](std::string_view function, std::string_view feature) {
            return function != "xrGetInstanceProcAddr" && feature != openxr_1_1 &&
                   (simulator::has_openxr_1_1 || feature != XR_KHR_LOCATE_SPACES_EXTENSION_NAME);
        };
#define ADD(name, feature) \
    if (has(#name, feature)) add(list, #name, load<PFN_##name>(#name));
        FOVERAY_SIMULATOR_FUNCTIONS(ADD)
#undef ADD
        return list;
    }

    DirectRuntime runtime_;
    Objects first_;
};

TEST_F(Handles, GarbageIsRefusedByEveryFunction) {
    int on_stack = 0;
    for (const HandleFunction& function : functions()) {
        for (const std::uint64_t garbage :
             {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{0x1234}, std::uint64_t{0xdeadbeef},
              ~std::uint64_t{0}, reinterpret_cast<std::uint64_t>(&on_stack)}) {
            EXPECT_EQ(function.call(garbage), XR_ERROR_HANDLE_INVALID) << function.name << ' ' << garbage;
        }
    }
}

TEST_F(Handles, HandlesOfAnotherTypeAreRefusedByEveryFunction) {
    for (const HandleFunction& function : functions()) {
        for (const TypedHandle& handle : first_.all()) {
            if (handle.type == function.type) continue;
            EXPECT_EQ(function.call(handle.value), XR_ERROR_HANDLE_INVALID)
                << function.name << " with " << handle.type.name();
        }
    }
}

TEST_F(Handles, DestroyedHandlesAreRefusedAndChildrenGoWithTheirParent) {
    const auto list = functions();
    ASSERT_EQ(load<PFN_xrDestroyInstance>("xrDestroyInstance")(first_.instance), XR_SUCCESS);
    for (const HandleFunction& function : list) {
        for (const TypedHandle& handle : first_.all())
            EXPECT_EQ(function.call(handle.value), XR_ERROR_HANDLE_INVALID) << function.name;
    }
}

TEST_F(Handles, EachIsDestroyedOnce) {
    const auto expect_once = [&](const char* name, auto function, auto handle) {
        EXPECT_EQ(function(handle), XR_SUCCESS) << name;
        EXPECT_EQ(function(handle), XR_ERROR_HANDLE_INVALID) << name;
    };
#define ONCE(name, handle) expect_once(#name, load<PFN_##name>(#name), handle)
    const auto destroy_action = load<PFN_xrDestroyAction>("xrDestroyAction");
    ONCE(xrDestroyDebugUtilsMessengerEXT, first_.messenger);
    ONCE(xrDestroyHandTrackerEXT, first_.tracker);
    ONCE(xrDestroySpace, first_.space);
    ONCE(xrDestroyAction, first_.action);
    ONCE(xrDestroyActionSet, first_.set);
    EXPECT_EQ(destroy_action(first_.buzz), XR_ERROR_HANDLE_INVALID) << "went with its set";
    ONCE(xrDestroySession, first_.session);
    const auto destroy_instance = load<PFN_xrDestroyInstance>("xrDestroyInstance");
    expect_once("xrDestroyInstance", destroy_instance, first_.instance);
#undef ONCE
}

TEST_F(Handles, HandlesOfAnotherInstanceAreRefused) {
    const Objects second = make();
    // The session, or the instance, of one with the object of the other.
    const XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1,
                                               &second.set};
    EXPECT_EQ(load<PFN_xrAttachSessionActionSets>("xrAttachSessionActionSets")(first_.session, &attach),
              XR_ERROR_HANDLE_INVALID);
    XrPath profile = XR_NULL_PATH, grip = XR_NULL_PATH;
    const auto to_path = load<PFN_xrStringToPath>("xrStringToPath");
    ASSERT_EQ(to_path(first_.instance, "/interaction_profiles/khr/simple_controller", &profile), XR_SUCCESS);
    ASSERT_EQ(to_path(first_.instance, "/user/hand/left/input/grip/pose", &grip), XR_SUCCESS);
    const XrActionSuggestedBinding binding{second.action, grip};
    const XrInteractionProfileSuggestedBinding suggestion{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING,
                                                          nullptr, profile, 1, &binding};
    EXPECT_EQ(load<PFN_xrSuggestInteractionProfileBindings>("xrSuggestInteractionProfileBindings")(
                  first_.instance, &suggestion),
              XR_ERROR_HANDLE_INVALID);
    const XrActionSpaceCreateInfo space_info{
        XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, second.action, XR_NULL_PATH, {{0, 0, 0, 1}, {0, 0, 0}}};
    XrSpace space = XR_NULL_HANDLE;
    EXPECT_EQ(load<PFN_xrCreateActionSpace>("xrCreateActionSpace")(first_.session, &space_info, &space),
              XR_ERROR_HANDLE_INVALID);
    const XrActionStateGetInfo get{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, second.action, XR_NULL_PATH};
    XrActionStatePose state{XR_TYPE_ACTION_STATE_POSE, nullptr, XR_FALSE};
    EXPECT_EQ(load<PFN_xrGetActionStatePose>("xrGetActionStatePose")(first_.session, &get, &state),
              XR_ERROR_HANDLE_INVALID);
    const XrHapticActionInfo haptic{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, second.buzz, XR_NULL_PATH};
    EXPECT_EQ(load<PFN_xrStopHapticFeedback>("xrStopHapticFeedback")(first_.session, &haptic),
              XR_ERROR_HANDLE_INVALID);
    const XrBoundSourcesForActionEnumerateInfo sources{XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO,
                                                       nullptr, second.action};
    std::uint32_t count = 0;
    EXPECT_EQ(load<PFN_xrEnumerateBoundSourcesForAction>("xrEnumerateBoundSourcesForAction")(
                  first_.session, &sources, 0, &count, nullptr),
              XR_ERROR_HANDLE_INVALID);
    const XrActiveActionSet active{second.set, XR_NULL_PATH};
    const XrActionsSyncInfo sync{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
    EXPECT_EQ(load<PFN_xrSyncActions>("xrSyncActions")(first_.session, &sync),
              XR_ERROR_ACTIONSET_NOT_ATTACHED);

    // Spaces of two sessions.
    XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, nullptr, 0, {}};
    EXPECT_EQ(load<PFN_xrLocateSpace>("xrLocateSpace")(first_.space, second.space, 1, &location),
              XR_ERROR_VALIDATION_FAILURE);
    const XrHandJointsLocateInfoEXT locate{XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT, nullptr, second.space, 1};
    std::vector<XrHandJointLocationEXT> joints(XR_HAND_JOINT_COUNT_EXT);
    XrHandJointLocationsEXT locations{XR_TYPE_HAND_JOINT_LOCATIONS_EXT, nullptr, XR_FALSE,
                                      XR_HAND_JOINT_COUNT_EXT, joints.data()};
    EXPECT_EQ(load<PFN_xrLocateHandJointsEXT>("xrLocateHandJointsEXT")(first_.tracker, &locate, &locations),
              XR_ERROR_VALIDATION_FAILURE);
    const XrViewLocateInfo views_info{XR_TYPE_VIEW_LOCATE_INFO, nullptr,
                                      XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, 1, second.space};
    XrViewState view_state{XR_TYPE_VIEW_STATE, nullptr, 0};
    EXPECT_EQ(load<PFN_xrLocateViews>("xrLocateViews")(first_.session, &views_info, &view_state, 0, &count,
                                                       nullptr),
              XR_ERROR_VALIDATION_FAILURE);
}

}  // namespace
}  // namespace foveray::simulator_tests
