#pragma once

#include <string_view>
#include <type_traits>

#include "xr/simulator/api/openxr_1_1.h"
#include "xr/simulator/api/openxr_vulkan.h"

/// Every OpenXR function of the runtime with the feature that brings it: an extension, OpenXR 1.1, or "" for
/// the core of 1.0. The *_api.cpp files define them: they verify arguments; what a call does stands in the
/// object's own file.
#define FOVERAY_SIMULATOR_FUNCTIONS(_)                                                \
    _(xrGetInstanceProcAddr, "")                                                      \
    _(xrEnumerateApiLayerProperties, "")                                              \
    _(xrEnumerateInstanceExtensionProperties, "")                                     \
    _(xrCreateInstance, "")                                                           \
    _(xrDestroyInstance, "")                                                          \
    _(xrGetInstanceProperties, "")                                                    \
    _(xrPollEvent, "")                                                                \
    _(xrResultToString, "")                                                           \
    _(xrStructureTypeToString, "")                                                    \
    _(xrStringToPath, "")                                                             \
    _(xrPathToString, "")                                                             \
    _(xrGetSystem, "")                                                                \
    _(xrGetSystemProperties, "")                                                      \
    _(xrEnumerateEnvironmentBlendModes, "")                                           \
    _(xrEnumerateViewConfigurations, "")                                              \
    _(xrGetViewConfigurationProperties, "")                                           \
    _(xrEnumerateViewConfigurationViews, "")                                          \
    _(xrCreateSession, "")                                                            \
    _(xrDestroySession, "")                                                           \
    _(xrBeginSession, "")                                                             \
    _(xrEndSession, "")                                                               \
    _(xrRequestExitSession, "")                                                       \
    _(xrWaitFrame, "")                                                                \
    _(xrBeginFrame, "")                                                               \
    _(xrEndFrame, "")                                                                 \
    _(xrLocateViews, "")                                                              \
    _(xrEnumerateReferenceSpaces, "")                                                 \
    _(xrCreateReferenceSpace, "")                                                     \
    _(xrGetReferenceSpaceBoundsRect, "")                                              \
    _(xrCreateActionSpace, "")                                                        \
    _(xrLocateSpace, "")                                                              \
    _(xrLocateSpaces, openxr_1_1)                                                     \
    _(xrLocateSpacesKHR, XR_KHR_LOCATE_SPACES_EXTENSION_NAME)                         \
    _(xrDestroySpace, "")                                                             \
    _(xrEnumerateSwapchainFormats, "")                                                \
    _(xrCreateSwapchain, "")                                                          \
    _(xrDestroySwapchain, "")                                                         \
    _(xrEnumerateSwapchainImages, "")                                                 \
    _(xrAcquireSwapchainImage, "")                                                    \
    _(xrWaitSwapchainImage, "")                                                       \
    _(xrReleaseSwapchainImage, "")                                                    \
    _(xrCreateActionSet, "")                                                          \
    _(xrDestroyActionSet, "")                                                         \
    _(xrCreateAction, "")                                                             \
    _(xrDestroyAction, "")                                                            \
    _(xrSuggestInteractionProfileBindings, "")                                        \
    _(xrAttachSessionActionSets, "")                                                  \
    _(xrGetCurrentInteractionProfile, "")                                             \
    _(xrGetActionStateBoolean, "")                                                    \
    _(xrGetActionStateFloat, "")                                                      \
    _(xrGetActionStateVector2f, "")                                                   \
    _(xrGetActionStatePose, "")                                                       \
    _(xrSyncActions, "")                                                              \
    _(xrEnumerateBoundSourcesForAction, "")                                           \
    _(xrGetInputSourceLocalizedName, "")                                              \
    _(xrApplyHapticFeedback, "")                                                      \
    _(xrStopHapticFeedback, "")                                                       \
    _(xrConvertTimespecTimeToTimeKHR, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME)    \
    _(xrConvertTimeToTimespecTimeKHR, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME)    \
    _(xrSetDebugUtilsObjectNameEXT, XR_EXT_DEBUG_UTILS_EXTENSION_NAME)                \
    _(xrCreateDebugUtilsMessengerEXT, XR_EXT_DEBUG_UTILS_EXTENSION_NAME)              \
    _(xrDestroyDebugUtilsMessengerEXT, XR_EXT_DEBUG_UTILS_EXTENSION_NAME)             \
    _(xrSubmitDebugUtilsMessageEXT, XR_EXT_DEBUG_UTILS_EXTENSION_NAME)                \
    _(xrSessionBeginDebugUtilsLabelRegionEXT, XR_EXT_DEBUG_UTILS_EXTENSION_NAME)      \
    _(xrSessionEndDebugUtilsLabelRegionEXT, XR_EXT_DEBUG_UTILS_EXTENSION_NAME)        \
    _(xrSessionInsertDebugUtilsLabelEXT, XR_EXT_DEBUG_UTILS_EXTENSION_NAME)           \
    _(xrCreateHandTrackerEXT, XR_EXT_HAND_TRACKING_EXTENSION_NAME)                    \
    _(xrDestroyHandTrackerEXT, XR_EXT_HAND_TRACKING_EXTENSION_NAME)                   \
    _(xrLocateHandJointsEXT, XR_EXT_HAND_TRACKING_EXTENSION_NAME)                     \
    _(xrSetInputDeviceActiveEXT, XR_EXT_CONFORMANCE_AUTOMATION_EXTENSION_NAME)        \
    _(xrSetInputDeviceStateBoolEXT, XR_EXT_CONFORMANCE_AUTOMATION_EXTENSION_NAME)     \
    _(xrSetInputDeviceStateFloatEXT, XR_EXT_CONFORMANCE_AUTOMATION_EXTENSION_NAME)    \
    _(xrSetInputDeviceStateVector2fEXT, XR_EXT_CONFORMANCE_AUTOMATION_EXTENSION_NAME) \
    _(xrSetInputDeviceLocationEXT, XR_EXT_CONFORMANCE_AUTOMATION_EXTENSION_NAME)      \
    _(xrGetVisibilityMaskKHR, XR_KHR_VISIBILITY_MASK_EXTENSION_NAME)                  \
    _(xrGetVulkanInstanceExtensionsKHR, XR_KHR_VULKAN_ENABLE_EXTENSION_NAME)          \
    _(xrGetVulkanDeviceExtensionsKHR, XR_KHR_VULKAN_ENABLE_EXTENSION_NAME)            \
    _(xrGetVulkanGraphicsDeviceKHR, XR_KHR_VULKAN_ENABLE_EXTENSION_NAME)              \
    _(xrGetVulkanGraphicsRequirementsKHR, XR_KHR_VULKAN_ENABLE_EXTENSION_NAME)        \
    _(xrCreateVulkanInstanceKHR, XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME)                \
    _(xrCreateVulkanDeviceKHR, XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME)                  \
    _(xrGetVulkanGraphicsDevice2KHR, XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME)            \
    _(xrGetVulkanGraphicsRequirements2KHR, XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME)

namespace foveray::simulator {

#define FOVERAY_DECLARE(name, feature) std::remove_pointer_t<PFN_##name> name;
FOVERAY_SIMULATOR_FUNCTIONS(FOVERAY_DECLARE)
#undef FOVERAY_DECLARE

/// What a function's handle belongs to.
enum class Owner { None, Instance, Session };

struct FunctionEntry {
    std::string_view name;
    PFN_xrVoidFunction function;  // for clients: asks the script first whether the call fails
    std::string_view feature;
    Owner owner;
};

/// nullptr when there is none of that name.
const FunctionEntry* find_function(std::string_view name);

}  // namespace foveray::simulator
