#include "xr/simulator/api/return_codes.h"

#include <algorithm>
#include <string>

#include "xr/simulator/api/names.h"

namespace foveray::simulator {
namespace {

struct OwnCodes {
    std::string_view function, codes;
};

// As the specification's registry (xr.xml) has it; without XR_ERROR_, and without those that follow from
// what a function is called on.
constexpr OwnCodes own_codes[] = {
    {"xrGetInstanceProcAddr", "FUNCTION_UNSUPPORTED OUT_OF_MEMORY"},
    {"xrEnumerateApiLayerProperties", "OUT_OF_MEMORY SIZE_INSUFFICIENT"},
    {"xrEnumerateInstanceExtensionProperties",
     "OUT_OF_MEMORY SIZE_INSUFFICIENT RUNTIME_UNAVAILABLE API_LAYER_NOT_PRESENT"},
    {"xrCreateInstance",
     "OUT_OF_MEMORY LIMIT_REACHED RUNTIME_UNAVAILABLE NAME_INVALID INITIALIZATION_FAILED "
     "EXTENSION_NOT_PRESENT EXTENSION_DEPENDENCY_NOT_ENABLED API_VERSION_UNSUPPORTED API_LAYER_NOT_PRESENT"},
    {"xrStringToPath", "PATH_FORMAT_INVALID PATH_COUNT_EXCEEDED"},
    {"xrPathToString", "SIZE_INSUFFICIENT PATH_INVALID"},
    {"xrGetSystem", "FORM_FACTOR_UNSUPPORTED FORM_FACTOR_UNAVAILABLE"},
    {"xrGetSystemProperties", "OUT_OF_MEMORY SYSTEM_INVALID"},
    {"xrEnumerateEnvironmentBlendModes",
     "SIZE_INSUFFICIENT VIEW_CONFIGURATION_TYPE_UNSUPPORTED SYSTEM_INVALID"},
    {"xrEnumerateViewConfigurations", "SIZE_INSUFFICIENT SYSTEM_INVALID"},
    {"xrGetViewConfigurationProperties", "VIEW_CONFIGURATION_TYPE_UNSUPPORTED SYSTEM_INVALID"},
    {"xrEnumerateViewConfigurationViews",
     "SIZE_INSUFFICIENT VIEW_CONFIGURATION_TYPE_UNSUPPORTED SYSTEM_INVALID"},
    {"xrCreateSession",
     "OUT_OF_MEMORY LIMIT_REACHED SYSTEM_INVALID INITIALIZATION_FAILED GRAPHICS_REQUIREMENTS_CALL_MISSING "
     "GRAPHICS_DEVICE_INVALID"},
    {"xrBeginSession", "VIEW_CONFIGURATION_TYPE_UNSUPPORTED SESSION_RUNNING SESSION_NOT_READY"},
    {"xrEndSession", "SESSION_NOT_STOPPING SESSION_NOT_RUNNING"},
    {"xrRequestExitSession", "SESSION_NOT_RUNNING"},
    {"xrWaitFrame", "SESSION_NOT_RUNNING"},
    {"xrBeginFrame", "SESSION_NOT_RUNNING CALL_ORDER_INVALID"},
    {"xrEndFrame",
     "TIME_INVALID SWAPCHAIN_RECT_INVALID SESSION_NOT_RUNNING POSE_INVALID LAYER_LIMIT_EXCEEDED "
     "LAYER_INVALID ENVIRONMENT_BLEND_MODE_UNSUPPORTED CALL_ORDER_INVALID"},
    {"xrLocateViews", "SIZE_INSUFFICIENT VIEW_CONFIGURATION_TYPE_UNSUPPORTED TIME_INVALID"},
    {"xrEnumerateReferenceSpaces", "SIZE_INSUFFICIENT"},
    {"xrCreateReferenceSpace", "OUT_OF_MEMORY LIMIT_REACHED REFERENCE_SPACE_UNSUPPORTED POSE_INVALID"},
    {"xrGetReferenceSpaceBoundsRect", "FUNCTION_UNSUPPORTED REFERENCE_SPACE_UNSUPPORTED"},
    {"xrCreateActionSpace",
     "OUT_OF_MEMORY LIMIT_REACHED POSE_INVALID PATH_UNSUPPORTED PATH_INVALID ACTION_TYPE_MISMATCH"},
    {"xrLocateSpace", "TIME_INVALID"},
    {"xrEnumerateSwapchainFormats", "SIZE_INSUFFICIENT"},
    {"xrCreateSwapchain", "OUT_OF_MEMORY LIMIT_REACHED SWAPCHAIN_FORMAT_UNSUPPORTED FEATURE_UNSUPPORTED"},
    {"xrEnumerateSwapchainImages", "SIZE_INSUFFICIENT"},
    {"xrAcquireSwapchainImage", "CALL_ORDER_INVALID"},
    {"xrWaitSwapchainImage", "CALL_ORDER_INVALID"},
    {"xrReleaseSwapchainImage", "CALL_ORDER_INVALID"},
    {"xrCreateActionSet",
     "OUT_OF_MEMORY LIMIT_REACHED PATH_FORMAT_INVALID NAME_INVALID NAME_DUPLICATED LOCALIZED_NAME_INVALID "
     "LOCALIZED_NAME_DUPLICATED"},
    {"xrCreateAction",
     "OUT_OF_MEMORY LIMIT_REACHED PATH_UNSUPPORTED PATH_INVALID PATH_FORMAT_INVALID NAME_INVALID "
     "NAME_DUPLICATED LOCALIZED_NAME_INVALID LOCALIZED_NAME_DUPLICATED ACTIONSETS_ALREADY_ATTACHED"},
    {"xrSuggestInteractionProfileBindings", "PATH_UNSUPPORTED PATH_INVALID ACTIONSETS_ALREADY_ATTACHED"},
    {"xrAttachSessionActionSets", "ACTIONSETS_ALREADY_ATTACHED"},
    {"xrGetCurrentInteractionProfile", "PATH_UNSUPPORTED PATH_INVALID ACTIONSET_NOT_ATTACHED"},
    {"xrGetActionStateBoolean", "PATH_UNSUPPORTED PATH_INVALID ACTION_TYPE_MISMATCH ACTIONSET_NOT_ATTACHED"},
    {"xrGetActionStateFloat", "PATH_UNSUPPORTED PATH_INVALID ACTION_TYPE_MISMATCH ACTIONSET_NOT_ATTACHED"},
    {"xrGetActionStateVector2f", "PATH_UNSUPPORTED PATH_INVALID ACTION_TYPE_MISMATCH ACTIONSET_NOT_ATTACHED"},
    {"xrGetActionStatePose", "PATH_UNSUPPORTED PATH_INVALID ACTION_TYPE_MISMATCH ACTIONSET_NOT_ATTACHED"},
    {"xrSyncActions", "PATH_UNSUPPORTED PATH_INVALID ACTIONSET_NOT_ATTACHED"},
    {"xrEnumerateBoundSourcesForAction", "SIZE_INSUFFICIENT PATH_INVALID ACTIONSET_NOT_ATTACHED"},
    {"xrGetInputSourceLocalizedName",
     "SIZE_INSUFFICIENT PATH_UNSUPPORTED PATH_INVALID ACTIONSET_NOT_ATTACHED"},
    {"xrApplyHapticFeedback", "PATH_UNSUPPORTED PATH_INVALID ACTION_TYPE_MISMATCH ACTIONSET_NOT_ATTACHED"},
    {"xrStopHapticFeedback", "PATH_UNSUPPORTED PATH_INVALID ACTION_TYPE_MISMATCH ACTIONSET_NOT_ATTACHED"},
    {"xrConvertTimespecTimeToTimeKHR", "TIME_INVALID"},
    {"xrConvertTimeToTimespecTimeKHR", "TIME_INVALID"},
    {"xrSetDebugUtilsObjectNameEXT", "OUT_OF_MEMORY"},
    {"xrCreateDebugUtilsMessengerEXT", "OUT_OF_MEMORY LIMIT_REACHED"},
    {"xrCreateHandTrackerEXT", "OUT_OF_MEMORY LIMIT_REACHED FEATURE_UNSUPPORTED"},
    {"xrLocateHandJointsEXT", "TIME_INVALID"},
    {"xrSetInputDeviceActiveEXT", "PATH_UNSUPPORTED PATH_INVALID"},
    {"xrSetInputDeviceStateBoolEXT", "PATH_UNSUPPORTED PATH_INVALID"},
    {"xrSetInputDeviceStateFloatEXT", "PATH_UNSUPPORTED PATH_INVALID"},
    {"xrSetInputDeviceStateVector2fEXT", "PATH_UNSUPPORTED PATH_INVALID"},
    {"xrSetInputDeviceLocationEXT", "POSE_INVALID PATH_UNSUPPORTED PATH_INVALID"},
    {"xrGetVisibilityMaskKHR", "SIZE_INSUFFICIENT VIEW_CONFIGURATION_TYPE_UNSUPPORTED"},
    {"xrGetVulkanInstanceExtensionsKHR", "SIZE_INSUFFICIENT SYSTEM_INVALID"},
    {"xrGetVulkanDeviceExtensionsKHR", "SIZE_INSUFFICIENT SYSTEM_INVALID"},
    {"xrGetVulkanGraphicsDeviceKHR", "SYSTEM_INVALID"},
    {"xrGetVulkanGraphicsRequirementsKHR", "SYSTEM_INVALID"},
    {"xrCreateVulkanInstanceKHR", "OUT_OF_MEMORY LIMIT_REACHED SYSTEM_INVALID"},
    {"xrCreateVulkanDeviceKHR", "OUT_OF_MEMORY LIMIT_REACHED SYSTEM_INVALID"},
    {"xrGetVulkanGraphicsDevice2KHR", "SYSTEM_INVALID"},
    {"xrLocateSpaces", "FUNCTION_UNSUPPORTED SIZE_INSUFFICIENT TIME_INVALID"},
    {"xrLocateSpacesKHR", "SIZE_INSUFFICIENT TIME_INVALID"},
    {"xrGetVulkanGraphicsRequirements2KHR", "SYSTEM_INVALID"},
};

}  // namespace

std::vector<std::string_view> error_codes(const FunctionEntry& function) {
    std::vector<std::string_view> codes;
    if (function.owner != Owner::None) codes.push_back("HANDLE_INVALID");
    if (!function.feature.empty()) codes.push_back("FUNCTION_UNSUPPORTED");
    if (!function.name.starts_with("xrDestroy")) {
        codes.insert(codes.end(), {"VALIDATION_FAILURE", "RUNTIME_FAILURE"});
        if (function.owner != Owner::None) codes.push_back("INSTANCE_LOST");
        if (function.owner == Owner::Session) codes.push_back("SESSION_LOST");
    }
    const auto own = std::ranges::find(own_codes, function.name, &OwnCodes::function);
    if (own == std::end(own_codes)) return codes;
    for (std::string_view rest = own->codes; !rest.empty();) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        codes.push_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return codes;
}

bool may_answer(const FunctionEntry& function, XrResult error) {
    const char* const name = name_of(error);
    return name && std::ranges::any_of(error_codes(function), [&](std::string_view code) {
               return name == "XR_ERROR_" + std::string(code);
           });
}

}  // namespace foveray::simulator
