#pragma once

#include "render/gpu/memory.h"

namespace foveray::render {

/// Makes the buffer at least so large, in device memory; what it held is lost when it grows. Waits for the
/// GPU then, because earlier frames may still use what is replaced.
void grow(const gpu::Device& device, gpu::Buffer& buffer, const char* name, vk::DeviceSize bytes);

}  // namespace foveray::render
