#include "render/grow.h"

namespace foveray::render {

void grow(const gpu::Device& device, gpu::Buffer& buffer, const char* name, vk::DeviceSize bytes) {
    if (buffer.size() >= bytes) return;
    device.vk().waitIdle();
    buffer = gpu::Buffer(device, name, bytes, gpu::Residence::Device);
}

}  // namespace foveray::render
