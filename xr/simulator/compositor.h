#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "xr/simulator/background_texture.h"
#include "xr/simulator/composition.h"
#include "xr/simulator/compute_pipelines.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {

/// What an eye is shown: rows from the top, four sRGB bytes a pixel, the last 255.
struct EyePicture {
    uvec2 size{0};
    std::span<const std::uint8_t> bytes;
};
using EyePictures = std::array<EyePicture, 2>;

/// Composes on the client's device and queue what the wearer sees. One caller at a time.
class Compositor {
  public:
    /// The client's queue must take compute commands. Throws Fault(BadInput) when the background cannot be
    /// read.
    Compositor(VulkanDevice& device, const Background& background);

    /// Uses the client's queue and waits for it. The pictures hold until the next call. Throws
    /// Fault(BadInput).
    EyePictures compose(const SubmittedFrame& frame, const std::array<EyeDisplay, 2>& eyes);
    /// The GPU's time for the last composition without the copy to the host; nothing where the queue cannot
    /// tell.
    std::optional<double> gpu_milliseconds() const { return gpu_milliseconds_; }

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
    std::optional<double> gpu_milliseconds_;
};

}  // namespace foveray::simulator
