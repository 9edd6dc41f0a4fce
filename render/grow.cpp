#include "render/grow.h"

#include <utility>

namespace foveray::render {

void grow(const gpu::Commands& cmd, gpu::Buffer& buffer, const char* name, vk::DeviceSize bytes) {
    if (buffer.size() >= bytes) return;
    if (buffer) cmd.release(std::move(buffer));
    buffer = gpu::Buffer(cmd.device(), name, bytes, gpu::Residence::Device);
}

}  // namespace foveray::render
