#include "tests/xr/simulator/vulkan_client.h"

#include <cstring>
#include <vector>

#include <gtest/gtest.h>
#include <vulkan/vulkan_raii.hpp>

namespace foveray::simulator_tests {
namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    ADD_FAILURE() << "validation: " << data->pMessage;
    return VK_FALSE;
}

template <typename Function>
Function xr_function(XrInstance instance, const char* name) {
    PFN_xrVoidFunction function = nullptr;
    EXPECT_EQ(xrGetInstanceProcAddr(instance, name, &function), XR_SUCCESS) << name;
    return reinterpret_cast<Function>(function);
}

XrSystemId system_of(XrInstance instance) {
    const XrSystemGetInfo info{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    XrSystemId system = XR_NULL_SYSTEM_ID;
    EXPECT_EQ(xrGetSystem(instance, &info, &system), XR_SUCCESS);
    return system;
}

}  // namespace

struct VulkanClient::Implementation {
    vk::raii::Context context;
    vk::raii::Instance instance = nullptr;
    vk::raii::DebugUtilsMessengerEXT messenger = nullptr;
    vk::raii::PhysicalDevice physical = nullptr;
    vk::raii::Device device = nullptr;
    vk::raii::Queue queue = nullptr;
    vk::raii::CommandPool pool = nullptr;
    XrGraphicsBindingVulkanKHR binding{};

    Implementation(XrInstance xr, VulkanEnable enable);
    void make_through_runtime(XrInstance xr, XrSystemId system, const vk::InstanceCreateInfo& instance_info,
                              const vk::DeviceCreateInfo& device_info);
    void make_itself(XrInstance xr, XrSystemId system, const vk::InstanceCreateInfo& instance_info,
                     const vk::DeviceCreateInfo& device_info);
    std::uint32_t memory_type(std::uint32_t bits) const;
};

VulkanClient::Implementation::Implementation(XrInstance xr, VulkanEnable enable) {
    const char* const layer = "VK_LAYER_KHRONOS_validation";
    const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                      VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    const vk::ValidationFeatureEnableEXT checks[] = {
        vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    const vk::ValidationFeaturesEXT features(checks);
    const vk::ApplicationInfo application("simulator tests", 0, nullptr, 0, VK_API_VERSION_1_3);
    const vk::InstanceCreateInfo instance_info({}, &application, layer, extensions, &features);
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue_info({}, 0, 1, &priority);
    const vk::DeviceCreateInfo device_info({}, queue_info);

    const XrSystemId system = system_of(xr);
    if (enable == VulkanEnable::Second) {
        make_through_runtime(xr, system, instance_info, device_info);
    } else {
        make_itself(xr, system, instance_info, device_info);
    }
    // As C's struct, because the callback's type differs between versions of Vulkan-Hpp.
    messenger = instance.createDebugUtilsMessengerEXT(VkDebugUtilsMessengerCreateInfoEXT{
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT, nullptr, 0,
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT,
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT, &on_message, nullptr});
    queue = device.getQueue(0, 0);
    pool = device.createCommandPool({vk::CommandPoolCreateFlagBits::eResetCommandBuffer, 0});
    binding = {XR_TYPE_GRAPHICS_BINDING_VULKAN_KHR,
               nullptr,
               static_cast<VkInstance>(*instance),
               static_cast<VkPhysicalDevice>(*physical),
               static_cast<VkDevice>(*device),
               0,
               0};
}

void VulkanClient::Implementation::make_through_runtime(XrInstance xr, XrSystemId system,
                                                        const vk::InstanceCreateInfo& instance_info,
                                                        const vk::DeviceCreateInfo& device_info) {
    XrGraphicsRequirementsVulkanKHR requirements{};
    requirements.type = XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR;
    EXPECT_EQ(xr_function<PFN_xrGetVulkanGraphicsRequirements2KHR>(xr, "xrGetVulkanGraphicsRequirements2KHR")(
                  xr, system, &requirements),
              XR_SUCCESS);
    EXPECT_LE(requirements.minApiVersionSupported, XR_MAKE_VERSION(1, 3, 0));

    XrVulkanInstanceCreateInfoKHR xr_instance_info{};
    xr_instance_info.type = XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR;
    xr_instance_info.systemId = system;
    xr_instance_info.pfnGetInstanceProcAddr = context.getDispatcher()->vkGetInstanceProcAddr;
    xr_instance_info.vulkanCreateInfo = &static_cast<const VkInstanceCreateInfo&>(instance_info);
    VkInstance made_instance = VK_NULL_HANDLE;
    VkResult result = VK_ERROR_UNKNOWN;
    EXPECT_EQ(xr_function<PFN_xrCreateVulkanInstanceKHR>(xr, "xrCreateVulkanInstanceKHR")(
                  xr, &xr_instance_info, &made_instance, &result),
              XR_SUCCESS);
    EXPECT_EQ(result, VK_SUCCESS);
    instance = vk::raii::Instance(context, made_instance);

    const XrVulkanGraphicsDeviceGetInfoKHR get_info{XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR, nullptr,
                                                    system, made_instance};
    VkPhysicalDevice chosen = VK_NULL_HANDLE;
    EXPECT_EQ(xr_function<PFN_xrGetVulkanGraphicsDevice2KHR>(xr, "xrGetVulkanGraphicsDevice2KHR")(
                  xr, &get_info, &chosen),
              XR_SUCCESS);
    physical = vk::raii::PhysicalDevice(instance, chosen);

    XrVulkanDeviceCreateInfoKHR xr_device_info{};
    xr_device_info.type = XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR;
    xr_device_info.systemId = system;
    xr_device_info.pfnGetInstanceProcAddr = context.getDispatcher()->vkGetInstanceProcAddr;
    xr_device_info.vulkanPhysicalDevice = chosen;
    xr_device_info.vulkanCreateInfo = &static_cast<const VkDeviceCreateInfo&>(device_info);
    VkDevice made_device = VK_NULL_HANDLE;
    EXPECT_EQ(xr_function<PFN_xrCreateVulkanDeviceKHR>(xr, "xrCreateVulkanDeviceKHR")(xr, &xr_device_info,
                                                                                      &made_device, &result),
              XR_SUCCESS);
    EXPECT_EQ(result, VK_SUCCESS);
    device = vk::raii::Device(physical, made_device);
}

void VulkanClient::Implementation::make_itself(XrInstance xr, XrSystemId system,
                                               const vk::InstanceCreateInfo& instance_info,
                                               const vk::DeviceCreateInfo& device_info) {
    XrGraphicsRequirementsVulkanKHR requirements{};
    requirements.type = XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN_KHR;
    EXPECT_EQ(xr_function<PFN_xrGetVulkanGraphicsRequirementsKHR>(xr, "xrGetVulkanGraphicsRequirementsKHR")(
                  xr, system, &requirements),
              XR_SUCCESS);
    for (const char* name : {"xrGetVulkanInstanceExtensionsKHR", "xrGetVulkanDeviceExtensionsKHR"}) {
        std::uint32_t size = 0;
        char text[8] = "?";
        EXPECT_EQ(xr_function<PFN_xrGetVulkanInstanceExtensionsKHR>(xr, name)(xr, system, 8, &size, text),
                  XR_SUCCESS);
        EXPECT_STREQ(text, "") << "no extension is needed";
    }
    instance = context.createInstance(instance_info);
    VkPhysicalDevice chosen = VK_NULL_HANDLE;
    EXPECT_EQ(xr_function<PFN_xrGetVulkanGraphicsDeviceKHR>(xr, "xrGetVulkanGraphicsDeviceKHR")(
                  xr, system, static_cast<VkInstance>(*instance), &chosen),
              XR_SUCCESS);
    physical = vk::raii::PhysicalDevice(instance, chosen);
    device = physical.createDevice(device_info);
}

std::uint32_t VulkanClient::Implementation::memory_type(std::uint32_t bits) const {
    const auto properties = physical.getMemoryProperties();
    const auto wanted = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
        if ((bits & (1u << i)) && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    }
    throw std::runtime_error("no host-visible memory");
}

VulkanClient::VulkanClient(XrInstance instance, VulkanEnable enable)
    : implementation_(std::make_unique<Implementation>(instance, enable)) {}
VulkanClient::~VulkanClient() = default;

const XrGraphicsBindingVulkanKHR& VulkanClient::binding() const { return implementation_->binding; }

void VulkanClient::fill(VkImage image, std::uint32_t layer, VkRect2D rect, Color color) {
    auto& [context, instance, messenger, physical, device, queue, pool, binding] = *implementation_;
    const std::size_t pixels = std::size_t{rect.extent.width} * rect.extent.height;
    const vk::raii::Buffer buffer =
        device.createBuffer({{}, 4 * pixels, vk::BufferUsageFlagBits::eTransferSrc});
    const auto needs = buffer.getMemoryRequirements();
    const vk::raii::DeviceMemory memory =
        device.allocateMemory({needs.size, implementation_->memory_type(needs.memoryTypeBits)});
    buffer.bindMemory(*memory, 0);
    auto* bytes = static_cast<std::uint8_t*>(memory.mapMemory(0, VK_WHOLE_SIZE));
    for (std::size_t i = 0; i < pixels; ++i) std::memcpy(bytes + 4 * i, color.data(), 4);
    memory.unmapMemory();

    const auto commands =
        std::move(device.allocateCommandBuffers({*pool, vk::CommandBufferLevel::ePrimary, 1}).front());
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    const auto change_layout = [&](vk::ImageLayout from, vk::ImageLayout to) {
        const auto all = vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite;
        const vk::ImageMemoryBarrier barrier(all, all, from, to, VK_QUEUE_FAMILY_IGNORED,
                                             VK_QUEUE_FAMILY_IGNORED, image,
                                             {vk::ImageAspectFlagBits::eColor, 0, 1, layer, 1});
        commands.pipelineBarrier(vk::PipelineStageFlagBits::eAllCommands,
                                 vk::PipelineStageFlagBits::eAllCommands, {}, {}, {}, barrier);
    };
    change_layout(vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::eTransferDstOptimal);
    const vk::BufferImageCopy region(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, layer, 1},
                                     {rect.offset.x, rect.offset.y, 0},
                                     {rect.extent.width, rect.extent.height, 1});
    commands.copyBufferToImage(*buffer, image, vk::ImageLayout::eTransferDstOptimal, region);
    change_layout(vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::eColorAttachmentOptimal);
    commands.end();
    queue.submit(vk::SubmitInfo({}, {}, *commands));
    queue.waitIdle();
}

}  // namespace foveray::simulator_tests
