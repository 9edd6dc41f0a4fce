#include "xr/client/instance.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "base/error.h"
#include "base/log.h"

namespace foveray::xr {
namespace {

constexpr std::array wanted_extensions = {
    XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME,  XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
    XR_KHR_VISIBILITY_MASK_EXTENSION_NAME, XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME,
    XR_VARJO_QUAD_VIEWS_EXTENSION_NAME,    XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME,
};

constexpr const char* remedy =
    "start or install an OpenXR runtime, or use --runtime simulator; XR_LOADER_DEBUG=error tells more";

std::set<std::string> offered_extensions() {
    std::uint32_t count = 0;
    if (const XrResult result = xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr);
        XR_FAILED(result)) {
        throw_missing(
            "OpenXR",
            "no runtime answers: xrEnumerateInstanceExtensionProperties failed with " + result_name(result),
            remedy);
    }
    std::vector<XrExtensionProperties> properties(count, {XR_TYPE_EXTENSION_PROPERTIES, nullptr, "", 0});
    check(xrEnumerateInstanceExtensionProperties(nullptr, count, &count, properties.data()),
          "xrEnumerateInstanceExtensionProperties");
    std::set<std::string> names;
    for (const auto& p : properties) names.insert(p.extensionName);
    return names;
}

BlendMode to_blend_mode(XrEnvironmentBlendMode mode) {
    switch (mode) {
        case XR_ENVIRONMENT_BLEND_MODE_ADDITIVE:
            return BlendMode::Additive;
        case XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND:
            return BlendMode::AlphaBlend;
        default:
            return BlendMode::Opaque;
    }
}

}  // namespace

void Instance::reconnect() {
    instance_.reset();
    connect();
}

void Instance::connect() {
    // Or the loader writes to stderr that a runtime refuses 1.1, which is no error here.
    ::setenv("XR_LOADER_DEBUG", "none", 0);
    const std::set<std::string> offered = offered_extensions();
    if (!offered.contains(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME)) {
        throw_missing("OpenXR runtime", "it lacks XR_KHR_vulkan_enable2",
                      "use another OpenXR runtime, or --runtime simulator");
    }
    enabled_.clear();
    std::vector<const char*> names;
    for (const char* name : wanted_extensions) {
        if (!offered.contains(name)) continue;
        enabled_.insert(name);
        names.push_back(name);
    }
    XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
    std::strcpy(info.applicationInfo.applicationName, "foveray");
    std::strcpy(info.applicationInfo.engineName, "foveray");
    info.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
    info.enabledExtensionNames = names.data();
    XrResult result = XR_ERROR_API_VERSION_UNSUPPORTED;
    for (const XrVersion version : {XR_CURRENT_API_VERSION, XR_MAKE_VERSION(1, 0, 0)}) {
        info.applicationInfo.apiVersion = version;
        result = xrCreateInstance(&info, instance_.put());
        if (result != XR_ERROR_API_VERSION_UNSUPPORTED) break;
    }
    if (XR_FAILED(result))
        throw_missing("OpenXR", "no runtime answers: xrCreateInstance failed with " + result_name(result),
                      remedy);
}

bool Instance::find_headset() {
    XrInstanceProperties properties{XR_TYPE_INSTANCE_PROPERTIES};
    check(xrGetInstanceProperties(get(), &properties), "xrGetInstanceProperties");
    runtime_name_ = properties.runtimeName;
    const XrSystemGetInfo get_info{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    const XrResult result = xrGetSystem(get(), &get_info, &system_);
    if (result == XR_ERROR_FORM_FACTOR_UNAVAILABLE) return false;
    if (result == XR_ERROR_FORM_FACTOR_UNSUPPORTED) {
        throw_missing("OpenXR runtime " + runtime_name_, "it knows of no headset: " + result_name(result),
                      "use a runtime that has one, or --runtime simulator");
    }
    check(result, "xrGetSystem");
    read_properties();
    read_view_configuration();
    return true;
}

void Instance::read_properties() {
    XrSystemFoveatedRenderingPropertiesVARJO foveated{XR_TYPE_SYSTEM_FOVEATED_RENDERING_PROPERTIES_VARJO};
    XrSystemEyeGazeInteractionPropertiesEXT gaze{XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT};
    XrSystemProperties properties{XR_TYPE_SYSTEM_PROPERTIES};
    void** next = &properties.next;
    const auto chain = [&](const char* extension, auto& part) {
        if (!has(extension)) return;
        *next = &part;
        next = &part.next;
    };
    chain(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME, gaze);
    chain(XR_VARJO_FOVEATED_RENDERING_EXTENSION_NAME, foveated);
    check(xrGetSystemProperties(get(), system_, &properties), "xrGetSystemProperties");
    system_name_ = properties.systemName;
    has_eye_tracking_ = gaze.supportsEyeGazeInteraction == XR_TRUE;
    can_foveate_ = foveated.supportsFoveatedRendering == XR_TRUE;
}

void Instance::read_view_configuration() {
    std::uint32_t count = 0;
    check(xrEnumerateViewConfigurations(get(), system_, 0, &count, nullptr), "xrEnumerateViewConfigurations");
    std::vector<XrViewConfigurationType> types(count);
    check(xrEnumerateViewConfigurations(get(), system_, count, &count, types.data()),
          "xrEnumerateViewConfigurations");
    const auto offers = [&](auto type) { return std::find(types.begin(), types.end(), type) != types.end(); };
    view_configuration_ = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    if (offers(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO)) {
        view_configuration_ = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO;
    } else if (!offers(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO)) {
        throw_missing("OpenXR runtime " + runtime_name_, "its device shows no stereo pictures",
                      "use a headset, or --runtime simulator");
    }

    check(xrEnumerateEnvironmentBlendModes(get(), system_, view_configuration_, 0, &count, nullptr),
          "xrEnumerateEnvironmentBlendModes");
    std::vector<XrEnvironmentBlendMode> modes(count);
    check(xrEnumerateEnvironmentBlendModes(get(), system_, view_configuration_, count, &count, modes.data()),
          "xrEnumerateEnvironmentBlendModes");
    blend_modes_.clear();
    for (const auto mode : modes) blend_modes_.push_back(to_blend_mode(mode));
}

std::vector<uvec2> Instance::view_sizes(bool foveated) const {
    std::uint32_t count = 0;
    check(xrEnumerateViewConfigurationViews(get(), system_, view_configuration_, 0, &count, nullptr),
          "xrEnumerateViewConfigurationViews");
    std::vector<XrFoveatedViewConfigurationViewVARJO> foveation(
        count, {XR_TYPE_FOVEATED_VIEW_CONFIGURATION_VIEW_VARJO, nullptr, foveated});
    std::vector<XrViewConfigurationView> views(count, {XR_TYPE_VIEW_CONFIGURATION_VIEW});
    if (can_foveate_) {
        for (std::uint32_t i = 0; i < count; ++i) views[i].next = &foveation[i];
    }
    check(xrEnumerateViewConfigurationViews(get(), system_, view_configuration_, count, &count, views.data()),
          "xrEnumerateViewConfigurationViews");
    std::vector<uvec2> sizes;
    for (const auto& view : views)
        sizes.emplace_back(view.recommendedImageRectWidth, view.recommendedImageRectHeight);
    return sizes;
}

XrPath Instance::path(const char* text) const {
    XrPath path = XR_NULL_PATH;
    check(xrStringToPath(get(), text, &path), "xrStringToPath");
    return path;
}

gpu::DeviceSource Instance::device_source() const {
    const auto requirements =
        function<PFN_xrGetVulkanGraphicsRequirements2KHR>("xrGetVulkanGraphicsRequirements2KHR");
    XrGraphicsRequirementsVulkan2KHR needed{XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR};
    check(requirements(get(), system_, &needed), "xrGetVulkanGraphicsRequirements2KHR");
    if (needed.minApiVersionSupported > XR_MAKE_VERSION(1, 3, 0)) {
        log::debug("{} wants Vulkan newer than 1.3", runtime_name_);
    }

    gpu::DeviceSource source;
    source.create_instance = [this](PFN_vkGetInstanceProcAddr get_proc, const VkInstanceCreateInfo& info,
                                    VkInstance* instance) {
        const auto create = function<PFN_xrCreateVulkanInstanceKHR>("xrCreateVulkanInstanceKHR");
        XrVulkanInstanceCreateInfoKHR xr_info{XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR};
        xr_info.systemId = system_;
        xr_info.pfnGetInstanceProcAddr = get_proc;
        xr_info.vulkanCreateInfo = &info;
        VkResult result = VK_SUCCESS;
        check(create(get(), &xr_info, instance, &result), "xrCreateVulkanInstanceKHR");
        return result;
    };
    source.choose_physical_device = [this](VkInstance instance) {
        const auto choose = function<PFN_xrGetVulkanGraphicsDevice2KHR>("xrGetVulkanGraphicsDevice2KHR");
        XrVulkanGraphicsDeviceGetInfoKHR info{XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR};
        info.systemId = system_;
        info.vulkanInstance = instance;
        VkPhysicalDevice physical = VK_NULL_HANDLE;
        check(choose(get(), &info, &physical), "xrGetVulkanGraphicsDevice2KHR");
        return physical;
    };
    source.create_device = [this](PFN_vkGetInstanceProcAddr get_proc, VkPhysicalDevice physical,
                                  const VkDeviceCreateInfo& info, VkDevice* device) {
        const auto create = function<PFN_xrCreateVulkanDeviceKHR>("xrCreateVulkanDeviceKHR");
        XrVulkanDeviceCreateInfoKHR xr_info{XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR};
        xr_info.systemId = system_;
        xr_info.pfnGetInstanceProcAddr = get_proc;
        xr_info.vulkanPhysicalDevice = physical;
        xr_info.vulkanCreateInfo = &info;
        VkResult result = VK_SUCCESS;
        check(create(get(), &xr_info, device, &result), "xrCreateVulkanDeviceKHR");
        return result;
    };
    return source;
}

}  // namespace foveray::xr
