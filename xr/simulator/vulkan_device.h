#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <vulkan/vulkan.h>

/// The client's Vulkan device, used through functions that the client's own loader gives.
namespace foveray::simulator {

/// VK_NO_PROTOTYPES: `get` comes from the client (XR_KHR_vulkan_enable2) or from the system's Vulkan loader.
struct VulkanInstanceFunctions {
    VulkanInstanceFunctions() = default;
    VulkanInstanceFunctions(VkInstance instance, PFN_vkGetInstanceProcAddr get);

    PFN_vkEnumeratePhysicalDevices vkEnumeratePhysicalDevices = nullptr;
    PFN_vkGetPhysicalDeviceProperties vkGetPhysicalDeviceProperties = nullptr;
    PFN_vkGetPhysicalDeviceMemoryProperties vkGetPhysicalDeviceMemoryProperties = nullptr;
    PFN_vkGetPhysicalDeviceImageFormatProperties vkGetPhysicalDeviceImageFormatProperties = nullptr;
    PFN_vkGetPhysicalDeviceQueueFamilyProperties vkGetPhysicalDeviceQueueFamilyProperties = nullptr;
    PFN_vkGetDeviceProcAddr vkGetDeviceProcAddr = nullptr;
};

/// How to reach the functions of a client's Vulkan instance.
struct VulkanLoader {
    PFN_vkGetInstanceProcAddr get = nullptr;
    bool has_debug_utils = false;  // VK_EXT_debug_utils is known to be enabled
};

/// vkGetInstanceProcAddr of the system's Vulkan loader. Throws Fault(Missing) without one.
PFN_vkGetInstanceProcAddr system_vulkan();

/// `index` counts in vkEnumeratePhysicalDevices; without it, the first of the fastest kind (discrete,
/// integrated, virtual, CPU). Throws Fault(BadInput) when there is no such device.
VkPhysicalDevice choose_gpu(VkInstance instance, const VulkanInstanceFunctions& functions,
                            std::optional<std::uint32_t> index);

// clang-format off
#define FOVERAY_SIMULATOR_VULKAN_FUNCTIONS(_)                                                     \
    _(vkGetDeviceQueue) _(vkQueueSubmit)                                                          \
    _(vkAllocateMemory) _(vkFreeMemory) _(vkMapMemory)                                            \
    _(vkCreateImage) _(vkDestroyImage) _(vkGetImageMemoryRequirements) _(vkBindImageMemory)       \
    _(vkCreateImageView) _(vkDestroyImageView) _(vkCreateSampler) _(vkDestroySampler)             \
    _(vkCreateBuffer) _(vkDestroyBuffer) _(vkGetBufferMemoryRequirements) _(vkBindBufferMemory)   \
    _(vkCreateShaderModule) _(vkDestroyShaderModule)                                              \
    _(vkCreateDescriptorSetLayout) _(vkDestroyDescriptorSetLayout)                                \
    _(vkCreatePipelineLayout) _(vkDestroyPipelineLayout)                                          \
    _(vkCreateComputePipelines) _(vkDestroyPipeline)                                              \
    _(vkCreateDescriptorPool) _(vkDestroyDescriptorPool) _(vkResetDescriptorPool)                 \
    _(vkAllocateDescriptorSets) _(vkUpdateDescriptorSets)                                         \
    _(vkCreateQueryPool) _(vkDestroyQueryPool) _(vkGetQueryPoolResults)                           \
    _(vkCreateCommandPool) _(vkDestroyCommandPool) _(vkResetCommandPool)                          \
    _(vkAllocateCommandBuffers) _(vkBeginCommandBuffer) _(vkEndCommandBuffer)                     \
    _(vkCmdPipelineBarrier) _(vkCmdFillBuffer) _(vkCmdCopyBuffer) _(vkCmdCopyBufferToImage)       \
    _(vkCmdCopyImageToBuffer) _(vkCmdBindPipeline) _(vkCmdBindDescriptorSets)                     \
    _(vkCmdPushConstants) _(vkCmdDispatch) _(vkCmdResetQueryPool) _(vkCmdWriteTimestamp)          \
    _(vkCreateFence) _(vkDestroyFence) _(vkResetFences) _(vkWaitForFences)
// clang-format on

/// A Vulkan object that belongs to a device and is destroyed with its owner. Move-only.
template <typename Handle>
class VulkanOwned {
  public:
    using Destroy = void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*);

    VulkanOwned() = default;
    VulkanOwned(VkDevice device, Handle handle, Destroy destroy)
        : device_(device), handle_(handle), destroy_(destroy) {}
    ~VulkanOwned() {
        if (handle_) destroy_(device_, handle_, nullptr);
    }
    VulkanOwned(VulkanOwned&& other) noexcept
        : device_(other.device_),
          handle_(std::exchange(other.handle_, VK_NULL_HANDLE)),
          destroy_(other.destroy_) {}
    VulkanOwned& operator=(VulkanOwned&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        std::swap(destroy_, other.destroy_);
        return *this;
    }
    Handle operator*() const { return handle_; }

  private:
    VkDevice device_ = VK_NULL_HANDLE;
    Handle handle_ = VK_NULL_HANDLE;
    Destroy destroy_ = nullptr;
};

/// A Vulkan call failed in a way that the client can only be told of. Ends the call with
/// XR_ERROR_RUNTIME_FAILURE, or XR_ERROR_OUT_OF_MEMORY.
void verify_vulkan(VkResult result, const char* call);

class VulkanDevice {
  public:
    struct Image {
        VulkanOwned<VkDeviceMemory> memory;
        VulkanOwned<VkImage> image;  // destroyed before its memory
    };
    struct Buffer {
        VulkanOwned<VkDeviceMemory> memory;
        VulkanOwned<VkBuffer> buffer;
        VkDeviceSize size = 0;
        void* mapped = nullptr;  // of the host's
    };
    /// Where a buffer lies: only the GPU sees it, or the host writes, or reads it; the host's are coherent.
    enum class Place { Gpu, Upload, Readback };

    VulkanDevice(VkInstance instance, VkPhysicalDevice physical, VkDevice device, std::uint32_t queue_family,
                 std::uint32_t queue_index, VulkanLoader loader);

    bool supports(const VkImageCreateInfo& info) const;
    Image create_image(const VkImageCreateInfo& info, const std::string& name) const;
    Buffer create_buffer(VkDeviceSize size, VkBufferUsageFlags usage, Place place,
                         const std::string& name) const;
    VulkanOwned<VkImageView> create_view(VkImage image, VkFormat format, VkImageAspectFlags aspect,
                                         std::uint32_t array_layer, const std::string& name) const;
    /// Takes a new object over and names it.
    template <typename Handle>
    VulkanOwned<Handle> own(Handle handle, typename VulkanOwned<Handle>::Destroy destroy, VkObjectType type,
                            const std::string& name) const {
        set_name(type, reinterpret_cast<std::uint64_t>(handle), name);
        return {device_, handle, destroy};
    }
    /// Records and submits to the client's queue, and waits until the GPU is done. Only in calls for which
    /// the client synchronises its queue.
    void submit(const std::function<void(VkCommandBuffer)>& record);

    /// Commands that the GPU runs while the host goes on.
    struct Batch {
        VulkanOwned<VkCommandPool> pool;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VulkanOwned<VkFence> fence;
    };
    Batch create_batch(const std::string& name) const;
    /// As `submit`, without the wait. What the batch was given before is finished.
    void start(const Batch& batch, const std::function<void(VkCommandBuffer)>& record);
    /// Waits until the GPU is done. From any thread.
    void finish(const Batch& batch) const;

    VkDevice handle() const { return device_; }
    const auto& functions() const { return functions_; }
    /// The client's queue takes compute commands.
    bool can_compute() const { return family_.queueFlags & VK_QUEUE_COMPUTE_BIT; }
    /// 0: the client's queue writes no timestamps.
    std::uint32_t timestamp_bits() const { return family_.timestampValidBits; }
    float nanoseconds_per_tick() const { return nanoseconds_per_tick_; }

  private:
    struct DeviceFunctions {
#define FOVERAY_MEMBER(name) PFN_##name name = nullptr;
        FOVERAY_SIMULATOR_VULKAN_FUNCTIONS(FOVERAY_MEMBER)
#undef FOVERAY_MEMBER
        PFN_vkSetDebugUtilsObjectNameEXT vkSetDebugUtilsObjectNameEXT = nullptr;  // only where enabled
    };
    VulkanOwned<VkDeviceMemory> allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted,
                                         VkMemoryPropertyFlags preferred, const std::string& name) const;
    void set_name(VkObjectType type, std::uint64_t handle, const std::string& name) const;

    VulkanInstanceFunctions instance_functions_;
    VkPhysicalDevice physical_;
    VkDevice device_;
    std::uint32_t queue_family_;
    VkQueue queue_ = VK_NULL_HANDLE;
    DeviceFunctions functions_;
    VkPhysicalDeviceMemoryProperties memory_{};
    VkQueueFamilyProperties family_{};
    float nanoseconds_per_tick_ = 0.0f;
    std::mutex batch_mutex_;
    Batch batch_;  // of `submit`
    std::mutex queue_mutex_;
};

}  // namespace foveray::simulator
