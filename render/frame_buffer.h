#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/gpu/commands.h"

namespace foveray::render {

/// Data that the CPU writes anew each frame and that shaders find at one address that never changes: staging
/// memory once a frame slot, and device memory that it is copied into. Move-only.
class FrameBuffer {
  public:
    FrameBuffer() = default;
    FrameBuffer(const gpu::Device& device, const std::string& name, vk::DeviceSize size, std::uint32_t slots);

    vk::DeviceAddress address() const { return device_buffer_.address(); }

    /// The slot's earlier frame must be done. The caller orders the copy (Access::TransferWrite) after
    /// earlier frames' reads and before this frame's. `data` has at most the size given above.
    void record(const gpu::Commands& cmd, std::uint32_t slot, std::span<const std::byte> data);

  private:
    std::vector<gpu::Buffer> staging_;
    gpu::Buffer device_buffer_;
};

}  // namespace foveray::render
