#include "render/frame_buffer.h"

#include <cassert>

namespace foveray::render {

FrameBuffer::FrameBuffer(const gpu::Device& device, const std::string& name, vk::DeviceSize size,
                         std::uint32_t slots)
    : device_buffer_(device, name, size, gpu::Residence::Device) {
    for (std::uint32_t i = 0; i < slots; ++i) {
        staging_.emplace_back(device, name + " staging " + std::to_string(i), size, gpu::Residence::Upload);
    }
}

void FrameBuffer::record(const gpu::Commands& cmd, std::uint32_t slot, std::span<const std::byte> data) {
    if (data.empty()) return;
    assert(slot < staging_.size() && data.size() <= device_buffer_.size());
    staging_[slot].write(data);
    cmd->copyBuffer(staging_[slot].vk(), device_buffer_.vk(), vk::BufferCopy(0, 0, data.size()));
}

}  // namespace foveray::render
