#pragma once

#include <filesystem>
#include <vector>

#include "base/image.h"
#include "xr/simulator/display/compositor.h"
#include "xr/simulator/display/layers.h"
#include "xr/simulator/options.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {

/// Writes what the headset shows as files: each view of the rearmost projection layer as submitted, and what
/// each eye is shown.
class Capture {
  public:
    Capture(const Options& options, VulkanDevice& device) : options_(options), device_(device) {}

    bool wants(std::uint64_t frame) const { return options_.captures(frame); }
    /// Uses the client's queue and waits for it. Throws Fault when a file cannot be written.
    void write(std::uint64_t frame, const std::vector<Layer>& layers, const EyePictures& shown);

  private:
    std::vector<Image> read_views(const Projection& projection);

    const Options& options_;
    VulkanDevice& device_;
    VulkanDevice::Buffer buffer_;
};

}  // namespace foveray::simulator
