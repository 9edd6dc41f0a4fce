#pragma once

#include <array>
#include <span>

#include "base/headset_profile.h"
#include "xr/simulator/layers.h"
#include "xr/simulator/merge.h"
#include "xr/simulator/options.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {

/// Writes what the headset shows as PNG: each view as submitted, and one merged picture an eye, opaque over
/// black.
class Capture {
  public:
    Capture(const Options& options, const HeadsetProfile& profile, VulkanDevice& device)
        : options_(options), profile_(profile), device_(device) {}

    bool wants(std::uint64_t frame) const { return options_.captures(frame); }
    /// Uses the client's queue and waits for it. Throws Fault when a file cannot be written.
    void write(std::uint64_t frame, std::span<const ProjectionLayer> layers);

  private:
    ViewPicture read(const ProjectionLayer& layer, const ProjectionView& view);
    FloatImage show(std::span<const std::vector<ViewPicture>> layers, std::size_t eye) const;

    const Options& options_;
    const HeadsetProfile& profile_;
    VulkanDevice& device_;
    VulkanDevice::Buffer buffer_;
};

}  // namespace foveray::simulator
