#include <array>

#include "xr/simulator/api/functions.h"
#include "xr/simulator/api/limits.h"
#include "xr/simulator/display/optics.h"
#include "xr/simulator/instance.h"

namespace foveray::simulator {
namespace {

void verify_view_configuration(const Instance& instance, XrViewConfigurationType type) {
    verify(instance.supports(type), XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL xrGetSystem(XrInstance instance, const XrSystemGetInfo* info,
                                           XrSystemId* system) {
    return guarded([&] {
        const auto object = get<Instance>(instance);
        verify_structure(info, XR_TYPE_SYSTEM_GET_INFO);
        verify(system != nullptr);
        verify(info->formFactor == XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY, XR_ERROR_FORM_FACTOR_UNSUPPORTED);
        verify(object->is_plugged_in(), XR_ERROR_FORM_FACTOR_UNAVAILABLE);
        *system = Instance::system_id;
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetSystemProperties(XrInstance instance, XrSystemId system,
                                                     XrSystemProperties* properties) {
    return guarded([&] {
        const auto object = get_system(instance, system);
        verify_structure(properties, XR_TYPE_SYSTEM_PROPERTIES);
        const HeadsetProfile& profile = object->profile();
        properties->systemId = system;
        properties->vendorId = 0;
        copy_text(properties->systemName, profile.display_name);
        properties->graphicsProperties = {max_swapchain_size, max_swapchain_size, max_layers};
        properties->trackingProperties = {XR_TRUE, XR_TRUE};
        // Structures of extensions that the client did not enable are ignored.
        if (auto* gaze = find_output<XrSystemEyeGazeInteractionPropertiesEXT>(
                properties->next, XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT);
            gaze && object->has(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME)) {
            gaze->supportsEyeGazeInteraction = profile.eye_tracking;
        }
        if (auto* hands = find_output<XrSystemHandTrackingPropertiesEXT>(
                properties->next, XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT);
            hands && object->has(XR_EXT_HAND_TRACKING_EXTENSION_NAME)) {
            hands->supportsHandTracking = XR_TRUE;
        }
        if (auto* presence = find_output<XrSystemUserPresencePropertiesEXT>(
                properties->next, XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT);
            presence && object->has(XR_EXT_USER_PRESENCE_EXTENSION_NAME)) {
            presence->supportsUserPresence = XR_TRUE;
        }
        if (auto* foveated = find_output<XrSystemFoveatedRenderingPropertiesVARJO>(
                properties->next, XR_TYPE_SYSTEM_FOVEATED_RENDERING_PROPERTIES_VARJO);
            foveated && object->has(XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME)) {
            foveated->supportsFoveatedRendering = profile.eye_tracking && profile.views.size() == 4;
        }
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrEnumerateEnvironmentBlendModes(XrInstance instance, XrSystemId system,
                                                                XrViewConfigurationType type,
                                                                std::uint32_t capacity, std::uint32_t* count,
                                                                XrEnvironmentBlendMode* modes) {
    return guarded([&] {
        const auto object = get_system(instance, system);
        verify_view_configuration(*object, type);
        const auto supported = object->blend_modes();
        enumerate_values<XrEnvironmentBlendMode>(supported, capacity, count, modes);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrEnumerateViewConfigurations(XrInstance instance, XrSystemId system,
                                                             std::uint32_t capacity, std::uint32_t* count,
                                                             XrViewConfigurationType* types) {
    return guarded([&] {
        const auto supported = get_system(instance, system)->view_configurations();
        enumerate_values<XrViewConfigurationType>(supported, capacity, count, types);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetViewConfigurationProperties(XrInstance instance, XrSystemId system,
                                                                XrViewConfigurationType type,
                                                                XrViewConfigurationProperties* properties) {
    return guarded([&] {
        verify_view_configuration(*get_system(instance, system), type);
        verify_structure(properties, XR_TYPE_VIEW_CONFIGURATION_PROPERTIES);
        properties->viewConfigurationType = type;
        properties->fovMutable = XR_TRUE;
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrEnumerateViewConfigurationViews(XrInstance instance, XrSystemId system,
                                                                 XrViewConfigurationType type,
                                                                 std::uint32_t capacity, std::uint32_t* count,
                                                                 XrViewConfigurationView* views) {
    return guarded([&] {
        const auto object = get_system(instance, system);
        verify_view_configuration(*object, type);
        const auto profiles = views_of(object->profile(), type);
        const auto describe = [&](XrViewConfigurationView& view, std::uint32_t i) {
            verify_structure(&view, XR_TYPE_VIEW_CONFIGURATION_VIEW);
            uvec2 size = profiles[i].size;
            const auto* foveated = find_output<XrFoveatedViewConfigurationViewVARJO>(
                view.next, XR_TYPE_FOVEATED_VIEW_CONFIGURATION_VIEW_VARJO);
            if (foveated && foveated->foveatedRenderingActive &&
                object->has(XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME))
                size = foveated_size(object->profile(), profiles[i]);
            view.recommendedImageRectWidth = size.x;
            view.recommendedImageRectHeight = size.y;
            view.maxImageRectWidth = max_view_size;
            view.maxImageRectHeight = max_view_size;
            view.recommendedSwapchainSampleCount = 1;
            view.maxSwapchainSampleCount = 1;
        };
        enumerate(static_cast<std::uint32_t>(profiles.size()), capacity, count, views, describe);
    });
}

}  // namespace foveray::simulator
