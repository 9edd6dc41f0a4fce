#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "xr/simulator/display/background_texture.h"
#include "xr/simulator/display/composition.h"
#include "xr/simulator/display/compute_pipelines.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {

/// What an eye is shown: rows from the top, four sRGB bytes a pixel, the last 255.
struct EyePicture {
    uvec2 size{0};
    std::span<const std::uint8_t> bytes;
};
using EyePictures = std::array<EyePicture, 2>;

/// Composes on the client's device and queue what the wearer sees, a frame at a time.
class Compositor {
  public:
    /// The client's queue must take compute commands. Throws Fault(BadInput) when the background cannot be
    /// read.
    Compositor(VulkanDevice& device, const Background& background);

    /// Uses the client's queue and lets the GPU work; the frame before is finished. Throws Fault(BadInput).
    void start(const SubmittedFrame& frame, const std::array<EyeDisplay, 2>& eyes);
    /// Waits for the frame that was started; its pictures hold until the next start. From any thread.
    EyePictures finish();
    /// Lets go of the finished frame's swapchains.
    void forget();
    /// The frame that was started last shows the swapchain.
    bool shows(const Swapchain& swapchain) const;
    /// The GPU's time for the last finished frame without the copy to the host; nothing where the queue
    /// cannot tell, and before any.
    std::optional<double> gpu_milliseconds() const;

  private:
    struct Dispatches;
    void make_buffers(const std::array<EyeDisplay, 2>& eyes);
    Dispatches gather(const SubmittedFrame& frame, const std::array<EyeDisplay, 2>& eyes);
    void record(VkCommandBuffer commands, const Dispatches& dispatches,
                const std::array<EyeDisplay, 2>& eyes);
    void record_timestamp(VkCommandBuffer commands, std::uint32_t query);
    void read_timestamps();

    VulkanDevice& device_;
    BackgroundTexture background_;
    ComputePipelines pipelines_;
    VulkanOwned<VkQueryPool> queries_;  // of two timestamps; null without
    VulkanDevice::Buffer draws_, bytes_, readback_;
    std::array<VulkanDevice::Buffer, 2> light_;  // by eye
    VulkanDevice::Batch batch_;
    std::array<uvec2, 2> sizes_{};  // of the frame's pictures
    mutable std::mutex frame_mutex_;
    SubmittedFrame frame_;  // holds its swapchains while the GPU reads them
    std::atomic<double> gpu_milliseconds_ = -1.0;
};

}  // namespace foveray::simulator
