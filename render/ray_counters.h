#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/gpu/commands.h"
#include "shaders/shared/light_layers.h"

namespace foveray::render {

/// Rays traced in one frame, by shared::COUNT_….
using RayCounts = std::array<std::uint64_t, shared::RAY_COUNTER_KINDS>;

/// Counts a frame's rays on the GPU: shaders add at `address()`.
class RayCounters {
  public:
    RayCounters(const gpu::Device& device, std::uint32_t slots);

    /// uint[RAY_COUNTER_KINDS][RAY_COUNTER_SLOTS], and where the log of rays is (shaders/shared/ray_log.h)
    vk::DeviceAddress address() const { return counters_.address(); }
    /// Before the frame's first ray. `log`: a shared::RayLog for the frame's rays, or 0.
    void clear(const gpu::Commands& cmd, vk::DeviceAddress log = 0) const;
    /// After its last one.
    void read_back(const gpu::Commands& cmd, std::uint32_t slot) const;
    /// Of the slot's newest frame that the GPU has finished.
    RayCounts counts(std::uint32_t slot) const;

  private:
    gpu::Buffer counters_;
    std::vector<gpu::Buffer> slots_;
};

}  // namespace foveray::render
