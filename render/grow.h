#pragma once

#include "render/gpu/commands.h"

namespace foveray::render {

/// Makes the buffer at least so large, in device memory; what it held is lost when it grows. Earlier frames
/// may go on using what is replaced.
void grow(const gpu::Commands& cmd, gpu::Buffer& buffer, const char* name, vk::DeviceSize bytes);

}  // namespace foveray::render
