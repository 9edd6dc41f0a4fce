#include "xr/simulator/api/functions.h"
#include "xr/simulator/instance.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {
namespace {

bool enables_debug_utils(const VkInstanceCreateInfo& info) {
    const std::span names(info.ppEnabledExtensionNames, info.enabledExtensionCount);
    return std::ranges::any_of(
        names, [](std::string_view name) { return name == VK_EXT_DEBUG_UTILS_EXTENSION_NAME; });
}

void describe_requirements(XrInstance instance, XrSystemId system,
                           XrGraphicsRequirementsVulkanKHR* requirements) {
    const auto object = get_system(instance, system);
    verify_structure(requirements, XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN_KHR);
    requirements->minApiVersionSupported = XR_MAKE_VERSION(1, 0, 0);
    requirements->maxApiVersionSupported = XR_MAKE_VERSION(1, 4, 0);
    object->graphics_requirements_asked();
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL xrGetVulkanInstanceExtensionsKHR(XrInstance instance, XrSystemId system,
                                                                std::uint32_t capacity, std::uint32_t* count,
                                                                char* buffer) {
    return guarded([&] {
        get_system(instance, system);
        enumerate_text("", capacity, count, buffer);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetVulkanDeviceExtensionsKHR(XrInstance instance, XrSystemId system,
                                                              std::uint32_t capacity, std::uint32_t* count,
                                                              char* buffer) {
    return guarded([&] {
        get_system(instance, system);
        enumerate_text("", capacity, count, buffer);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetVulkanGraphicsDeviceKHR(XrInstance instance, XrSystemId system,
                                                            VkInstance vulkan, VkPhysicalDevice* device) {
    return guarded([&] {
        const auto object = get_system(instance, system);
        verify(vulkan != VK_NULL_HANDLE && device != nullptr);
        *device = object->gpu(vulkan);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetVulkanGraphicsRequirementsKHR(
    XrInstance instance, XrSystemId system, XrGraphicsRequirementsVulkanKHR* requirements) {
    return guarded([&] { describe_requirements(instance, system, requirements); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetVulkanGraphicsRequirements2KHR(
    XrInstance instance, XrSystemId system, XrGraphicsRequirementsVulkanKHR* requirements) {
    return guarded([&] { describe_requirements(instance, system, requirements); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrGetVulkanGraphicsDevice2KHR(XrInstance instance,
                                                             const XrVulkanGraphicsDeviceGetInfoKHR* info,
                                                             VkPhysicalDevice* device) {
    return guarded([&] {
        get<Instance>(instance);
        verify_structure(info, XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR);
        const auto object = get_system(instance, info->systemId);
        verify(info->vulkanInstance != VK_NULL_HANDLE && device != nullptr);
        *device = object->gpu(info->vulkanInstance);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrCreateVulkanInstanceKHR(XrInstance instance,
                                                         const XrVulkanInstanceCreateInfoKHR* info,
                                                         VkInstance* vulkan, VkResult* result) {
    return guarded([&] {
        get<Instance>(instance);
        verify_structure(info, XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR);
        const auto object = get_system(instance, info->systemId);
        verify(info->createFlags == 0 && info->pfnGetInstanceProcAddr && info->vulkanCreateInfo && vulkan &&
               result);
        const auto create = reinterpret_cast<PFN_vkCreateInstance>(
            info->pfnGetInstanceProcAddr(VK_NULL_HANDLE, "vkCreateInstance"));
        verify(create != nullptr);
        *result = create(info->vulkanCreateInfo, info->vulkanAllocator, vulkan);
        if (*result == VK_SUCCESS) {
            object->remember_vulkan(
                *vulkan, {info->pfnGetInstanceProcAddr, enables_debug_utils(*info->vulkanCreateInfo)});
        }
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrCreateVulkanDeviceKHR(XrInstance instance,
                                                       const XrVulkanDeviceCreateInfoKHR* info,
                                                       VkDevice* device, VkResult* result) {
    return guarded([&] {
        get<Instance>(instance);
        verify_structure(info, XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR);
        const auto object = get_system(instance, info->systemId);
        verify(info->createFlags == 0 && info->pfnGetInstanceProcAddr && info->vulkanCreateInfo && device &&
               result);
        const VkInstance vulkan = object->vulkan_instance_of(info->vulkanPhysicalDevice);
        verify(vulkan != VK_NULL_HANDLE);
        const auto create =
            reinterpret_cast<PFN_vkCreateDevice>(info->pfnGetInstanceProcAddr(vulkan, "vkCreateDevice"));
        verify(create != nullptr);
        *result = create(info->vulkanPhysicalDevice, info->vulkanCreateInfo, info->vulkanAllocator, device);
    });
}

}  // namespace foveray::simulator
