#include "xr/simulator/vulkan_device.h"

#include <dlfcn.h>
#include <string>
#include <vector>

#include "base/error.h"
#include "xr/simulator/api/verify.h"

namespace foveray::simulator {

void verify_vulkan(VkResult result, const char* call) {
    if (result == VK_SUCCESS) return;
    report(std::string(call) + " failed with VkResult " + std::to_string(result));
    const bool memory = result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    throw Refusal{memory ? XR_ERROR_OUT_OF_MEMORY : XR_ERROR_RUNTIME_FAILURE};
}

VulkanInstanceFunctions::VulkanInstanceFunctions(VkInstance instance, PFN_vkGetInstanceProcAddr get) {
#define FOVERAY_LOAD(name)                                     \
    name = reinterpret_cast<PFN_##name>(get(instance, #name)); \
    verify(name != nullptr, XR_ERROR_RUNTIME_FAILURE);
    FOVERAY_LOAD(vkEnumeratePhysicalDevices)
    FOVERAY_LOAD(vkGetPhysicalDeviceProperties)
    FOVERAY_LOAD(vkGetPhysicalDeviceMemoryProperties)
    FOVERAY_LOAD(vkGetPhysicalDeviceImageFormatProperties)
    FOVERAY_LOAD(vkGetPhysicalDeviceQueueFamilyProperties)
    FOVERAY_LOAD(vkGetDeviceProcAddr)
#undef FOVERAY_LOAD
}

PFN_vkGetInstanceProcAddr system_vulkan() {
    // Never closed: the client uses the same library.
    static void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    auto* get = library ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"))
                        : nullptr;
    if (!get) throw_missing("libvulkan.so.1", "the Vulkan loader was not found", "install libvulkan1");
    return get;
}

VkPhysicalDevice choose_gpu(VkInstance instance, const VulkanInstanceFunctions& functions,
                            std::optional<std::uint32_t> index) {
    std::uint32_t count = 0;
    verify_vulkan(functions.vkEnumeratePhysicalDevices(instance, &count, nullptr),
                  "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    verify_vulkan(functions.vkEnumeratePhysicalDevices(instance, &count, devices.data()),
                  "vkEnumeratePhysicalDevices");
    if (index) {
        if (*index < devices.size()) return devices[*index];
        throw_bad_input("FOVERAY_SIMULATOR_GPU=" + std::to_string(*index),
                        "there are " + std::to_string(devices.size()) + " Vulkan devices",
                        "count them from 0");
    }
    for (const auto type :
         {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
          VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_CPU, VK_PHYSICAL_DEVICE_TYPE_OTHER}) {
        for (const VkPhysicalDevice device : devices) {
            VkPhysicalDeviceProperties properties{};
            functions.vkGetPhysicalDeviceProperties(device, &properties);
            if (properties.deviceType == type) return device;
        }
    }
    throw_missing("Vulkan", "there is no device", "install mesa-vulkan-drivers");
}

VulkanDevice::VulkanDevice(VkInstance instance, VkPhysicalDevice physical, VkDevice device,
                           std::uint32_t queue_family, std::uint32_t queue_index, VulkanLoader loader)
    : instance_functions_(instance, loader.get),
      physical_(physical),
      device_(device),
      queue_family_(queue_family) {
    const auto load = [&](const char* name) { return instance_functions_.vkGetDeviceProcAddr(device, name); };
#define FOVERAY_LOAD(name)                                       \
    functions_.name = reinterpret_cast<PFN_##name>(load(#name)); \
    verify(functions_.name != nullptr, XR_ERROR_GRAPHICS_DEVICE_INVALID);
    FOVERAY_SIMULATOR_VULKAN_FUNCTIONS(FOVERAY_LOAD)
#undef FOVERAY_LOAD
    if (loader.has_debug_utils) {
        functions_.vkSetDebugUtilsObjectNameEXT =
            reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(load("vkSetDebugUtilsObjectNameEXT"));
    }
    instance_functions_.vkGetPhysicalDeviceMemoryProperties(physical, &memory_);
    VkPhysicalDeviceProperties properties{};
    instance_functions_.vkGetPhysicalDeviceProperties(physical, &properties);
    nanoseconds_per_tick_ = properties.limits.timestampPeriod;
    std::uint32_t family_count = 0;
    instance_functions_.vkGetPhysicalDeviceQueueFamilyProperties(physical, &family_count, nullptr);
    std::vector<VkQueueFamilyProperties> families(family_count);
    instance_functions_.vkGetPhysicalDeviceQueueFamilyProperties(physical, &family_count, families.data());
    verify(queue_family < families.size(), XR_ERROR_GRAPHICS_DEVICE_INVALID);
    family_ = families[queue_family];
    functions_.vkGetDeviceQueue(device, queue_family, queue_index, &queue_);
    verify(queue_ != VK_NULL_HANDLE, XR_ERROR_GRAPHICS_DEVICE_INVALID);
    batch_ = create_batch("simulator commands");
}

VulkanDevice::Batch VulkanDevice::create_batch(const std::string& name) const {
    Batch batch;
    const VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr,
                                            VK_COMMAND_POOL_CREATE_TRANSIENT_BIT, queue_family_};
    VkCommandPool pool = VK_NULL_HANDLE;
    verify_vulkan(functions_.vkCreateCommandPool(device_, &pool_info, nullptr, &pool), "vkCreateCommandPool");
    batch.pool = own(pool, functions_.vkDestroyCommandPool, VK_OBJECT_TYPE_COMMAND_POOL, name + " pool");
    const VkCommandBufferAllocateInfo allocate_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr,
                                                    pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    verify_vulkan(functions_.vkAllocateCommandBuffers(device_, &allocate_info, &batch.commands),
                  "vkAllocateCommandBuffers");
    set_name(VK_OBJECT_TYPE_COMMAND_BUFFER, reinterpret_cast<std::uint64_t>(batch.commands), name);
    const VkFenceCreateInfo fence_info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
    VkFence fence = VK_NULL_HANDLE;
    verify_vulkan(functions_.vkCreateFence(device_, &fence_info, nullptr, &fence), "vkCreateFence");
    batch.fence = own(fence, functions_.vkDestroyFence, VK_OBJECT_TYPE_FENCE, name + " fence");
    return batch;
}

void VulkanDevice::set_name(VkObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!functions_.vkSetDebugUtilsObjectNameEXT) return;
    const VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr,
                                             type, handle, name.c_str()};
    functions_.vkSetDebugUtilsObjectNameEXT(device_, &info);
}

bool VulkanDevice::supports(const VkImageCreateInfo& info) const {
    VkImageFormatProperties limits{};
    return instance_functions_.vkGetPhysicalDeviceImageFormatProperties(
               physical_, info.format, info.imageType, info.tiling, info.usage, info.flags, &limits) ==
               VK_SUCCESS &&
           info.extent.width <= limits.maxExtent.width && info.extent.height <= limits.maxExtent.height &&
           info.arrayLayers <= limits.maxArrayLayers && info.mipLevels <= limits.maxMipLevels &&
           (info.samples & limits.sampleCounts);
}

VulkanOwned<VkDeviceMemory> VulkanDevice::allocate(const VkMemoryRequirements& needs,
                                                   VkMemoryPropertyFlags wanted,
                                                   VkMemoryPropertyFlags preferred,
                                                   const std::string& name) const {
    for (const VkMemoryPropertyFlags flags : {wanted | preferred, wanted}) {
        for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
            if (!(needs.memoryTypeBits & (1u << type))) continue;
            if ((memory_.memoryTypes[type].propertyFlags & flags) != flags) continue;
            const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
                                            type};
            VkDeviceMemory memory = VK_NULL_HANDLE;
            verify_vulkan(functions_.vkAllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
            return own(memory, functions_.vkFreeMemory, VK_OBJECT_TYPE_DEVICE_MEMORY, name + " memory");
        }
    }
    report("no Vulkan memory type fits " + name);
    throw Refusal{XR_ERROR_RUNTIME_FAILURE};
}

VulkanDevice::Image VulkanDevice::create_image(const VkImageCreateInfo& info, const std::string& name) const {
    Image result;
    VkImage image = VK_NULL_HANDLE;
    verify_vulkan(functions_.vkCreateImage(device_, &info, nullptr, &image), "vkCreateImage");
    result.image = own(image, functions_.vkDestroyImage, VK_OBJECT_TYPE_IMAGE, name);
    VkMemoryRequirements needs{};
    functions_.vkGetImageMemoryRequirements(device_, image, &needs);
    result.memory = allocate(needs, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, name);
    verify_vulkan(functions_.vkBindImageMemory(device_, image, *result.memory, 0), "vkBindImageMemory");
    return result;
}

VulkanOwned<VkImageView> VulkanDevice::create_view(VkImage image, VkFormat format, VkImageAspectFlags aspect,
                                                   std::uint32_t array_layer, const std::string& name) const {
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect, 0, 1, array_layer, 1};
    VkImageView view = VK_NULL_HANDLE;
    verify_vulkan(functions_.vkCreateImageView(device_, &info, nullptr, &view), "vkCreateImageView");
    return own(view, functions_.vkDestroyImageView, VK_OBJECT_TYPE_IMAGE_VIEW, name);
}

VulkanDevice::Buffer VulkanDevice::create_buffer(VkDeviceSize size, VkBufferUsageFlags usage, Place place,
                                                 const std::string& name) const {
    Buffer result;
    result.size = size;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    VkBuffer buffer = VK_NULL_HANDLE;
    verify_vulkan(functions_.vkCreateBuffer(device_, &info, nullptr, &buffer), "vkCreateBuffer");
    result.buffer = own(buffer, functions_.vkDestroyBuffer, VK_OBJECT_TYPE_BUFFER, name);
    VkMemoryRequirements needs{};
    functions_.vkGetBufferMemoryRequirements(device_, buffer, &needs);
    constexpr auto host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    result.memory = place == Place::Gpu ? allocate(needs, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, name)
                    : place == Place::Upload
                        ? allocate(needs, host, 0, name)
                        : allocate(needs, host, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, name);
    verify_vulkan(functions_.vkBindBufferMemory(device_, buffer, *result.memory, 0), "vkBindBufferMemory");
    if (place != Place::Gpu) {
        verify_vulkan(functions_.vkMapMemory(device_, *result.memory, 0, VK_WHOLE_SIZE, 0, &result.mapped),
                      "vkMapMemory");
    }
    return result;
}

void VulkanDevice::submit(const std::function<void(VkCommandBuffer)>& record) {
    const std::lock_guard lock(batch_mutex_);
    start(batch_, record);
    finish(batch_);
}

void VulkanDevice::start(const Batch& batch, const std::function<void(VkCommandBuffer)>& record) {
    verify_vulkan(functions_.vkResetCommandPool(device_, *batch.pool, 0), "vkResetCommandPool");
    const VkCommandBufferBeginInfo begin_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                              VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
    verify_vulkan(functions_.vkBeginCommandBuffer(batch.commands, &begin_info), "vkBeginCommandBuffer");
    record(batch.commands);
    verify_vulkan(functions_.vkEndCommandBuffer(batch.commands), "vkEndCommandBuffer");

    VkSubmitInfo submit_info{};
    submit_info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit_info.commandBufferCount = 1;
    submit_info.pCommandBuffers = &batch.commands;
    const VkFence fence = *batch.fence;
    verify_vulkan(functions_.vkResetFences(device_, 1, &fence), "vkResetFences");
    const std::lock_guard lock(queue_mutex_);
    verify_vulkan(functions_.vkQueueSubmit(queue_, 1, &submit_info, fence), "vkQueueSubmit");
}

void VulkanDevice::finish(const Batch& batch) const {
    const VkFence fence = *batch.fence;
    verify_vulkan(functions_.vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
}

}  // namespace foveray::simulator
