#include "tests/fuzz/vulkan_binding.h"

#include <dlfcn.h>

namespace foveray::fuzz {

std::optional<XrGraphicsBindingVulkanKHR> make_vulkan_binding(const simulator_tests::DirectRuntime& runtime,
                                                              const Functions& functions) {
    void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library) return std::nullopt;
    const auto get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
    VkInstanceCreateInfo instance_info{};
    instance_info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    XrGraphicsBindingVulkanKHR binding{};
    binding.type = XR_TYPE_GRAPHICS_BINDING_VULKAN_KHR;
    const auto create_instance = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
    if (create_instance(&instance_info, nullptr, &binding.instance) != VK_SUCCESS) return std::nullopt;

    const XrInstance instance = runtime.create_instance(extensions);
    const XrResult found =
        functions.xrGetVulkanGraphicsDeviceKHR(instance, 1, binding.instance, &binding.physicalDevice);
    functions.xrDestroyInstance(instance);
    if (found != XR_SUCCESS) return std::nullopt;

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo device_info{};
    device_info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue;
    const auto create_device = reinterpret_cast<PFN_vkCreateDevice>(get(binding.instance, "vkCreateDevice"));
    if (create_device(binding.physicalDevice, &device_info, nullptr, &binding.device) != VK_SUCCESS)
        return std::nullopt;
    return binding;
}

}  // namespace foveray::fuzz
