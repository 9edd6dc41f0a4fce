#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "render/gpu/vulkan.h"

struct VmaAllocator_T;

namespace foveray::gpu {

/// Lets somebody else make the Vulkan objects: OpenXR's XR_KHR_vulkan_enable2 dictates the physical device
/// and adds its own extensions to the instance and device. An empty function means that foveray does that
/// step itself.
struct DeviceSource {
    std::function<VkResult(PFN_vkGetInstanceProcAddr, const VkInstanceCreateInfo&, VkInstance*)>
        create_instance;
    std::function<VkPhysicalDevice(VkInstance)> choose_physical_device;
    std::function<VkResult(PFN_vkGetInstanceProcAddr, VkPhysicalDevice, const VkDeviceCreateInfo&, VkDevice*)>
        create_device;
};

struct DeviceOptions {
    bool validation = false;  // Khronos validation layer with synchronisation checks
    std::optional<std::uint32_t> index =
        {};  // into vkEnumeratePhysicalDevices; else the first suitable, GPUs first
    std::vector<std::string> instance_extensions = {};  // of a window system, say
    bool presentation = false;                          // VK_KHR_swapchain
};

/// Why foveray cannot run on a physical device; empty when it can.
std::vector<std::string> refusals(const vk::raii::PhysicalDevice& physical);

struct RayTracingLimits {
    std::uint32_t handle_size = 0, handle_alignment = 0, base_alignment = 0;
    std::uint32_t max_record_stride = 0, max_recursion = 0, scratch_alignment = 0;
    std::uint64_t max_instances = 0;
};

/// One Vulkan device with ray-tracing pipelines and one queue that does everything. Not movable: everything
/// made from it keeps a reference.
class Device {
  public:
    /// Throws Fault(Missing) that explains what each device lacks when none can be used.
    explicit Device(const DeviceOptions& options = {}, const DeviceSource& source = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const vk::raii::Instance& instance() const { return instance_; }
    const vk::raii::PhysicalDevice& physical() const { return physical_; }
    const vk::raii::Device& vk() const { return device_; }
    const vk::raii::Queue& queue() const { return queue_; }
    /// The queue takes one thread at a time: whoever uses it, an OpenXR runtime included, holds this.
    [[nodiscard]] std::unique_lock<std::mutex> lock_queue() const { return std::unique_lock(queue_mutex_); }
    /// On any thread.
    void submit(const vk::SubmitInfo2& info, vk::Fence fence) const;
    std::uint32_t queue_family() const { return queue_family_; }
    VmaAllocator_T* allocator() const { return allocator_; }
    const RayTracingLimits& limits() const { return limits_; }
    double timestamp_period_ns() const { return timestamp_period_ns_; }
    /// Of the queue family: higher bits of a timestamp mean nothing.
    std::uint32_t timestamp_valid_bits() const { return timestamp_valid_bits_; }
    /// Device and driver as one line, for reports.
    const std::string& name() const { return name_; }
    const std::string& driver() const { return driver_; }

    /// Validation errors and warnings so far; tests demand none.
    std::vector<std::string> validation_messages() const { return messages_->all(); }

    /// Debug name of any Vulkan object; a no-op without VK_EXT_debug_utils.
    template <typename Handle>
    void set_name(Handle handle, const std::string& name) const {
        set_name(Handle::objectType,
                 reinterpret_cast<std::uint64_t>(static_cast<typename Handle::NativeType>(handle)), name);
    }

    /// Drivers and layers report from any thread.
    class Messages {
      public:
        void add(const char* message);
        std::vector<std::string> all() const;

      private:
        mutable std::mutex mutex_;
        std::vector<std::string> messages_;
    };

  private:
    void set_name(vk::ObjectType type, std::uint64_t handle, const std::string& name) const;

    vk::raii::Context context_;
    std::unique_ptr<Messages> messages_;  // outlives the instance, which reports to it
    bool debug_utils_ = false;
    vk::raii::Instance instance_ = nullptr;
    vk::raii::DebugUtilsMessengerEXT messenger_ = nullptr;
    vk::raii::PhysicalDevice physical_ = nullptr;
    vk::raii::Device device_ = nullptr;
    vk::raii::Queue queue_ = nullptr;
    mutable std::mutex queue_mutex_;
    std::uint32_t queue_family_ = 0;
    VmaAllocator_T* allocator_ = nullptr;
    RayTracingLimits limits_;
    double timestamp_period_ns_ = 1.0;
    std::uint32_t timestamp_valid_bits_ = 64;
    std::string name_, driver_;
};

}  // namespace foveray::gpu
