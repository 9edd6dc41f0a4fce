#pragma once

#include <cstdint>
#include <vector>

#include "render/gpu/commands.h"
#include "xr/client/openxr.h"

namespace foveray::xr {

/// Images that the runtime shows. Filled by copies from buffers, because sRGB and depth images often allow no
/// storage writes.
class Swapchain {
  public:
    enum class Kind { Color, Depth };

    Swapchain() = default;
    /// Throws Fault(Missing) when the runtime lacks R8G8B8A8_SRGB (colour) or D32_SFLOAT (depth).
    Swapchain(XrSession session, Kind kind, uvec2 size, const char* name);

    XrSwapchain get() const { return handle_.get(); }
    explicit operator bool() const { return static_cast<bool>(handle_); }

    /// Gets an image that may be written, unless it has one. False: the runtime is not done with the image
    /// within half a second; a later call waits for the same one.
    bool acquire(const gpu::Device& device);
    /// Records the copy of a tightly packed picture into the top left corner of the acquired image.
    void record_copy(const gpu::Commands& cmd, vk::Buffer source, vk::DeviceSize offset, uvec2 size);
    /// After the copy was submitted.
    void release(const gpu::Device& device);

    static bool offers(XrSession session, Kind kind);

  private:
    Kind kind_ = Kind::Color;
    SwapchainHandle handle_;
    std::vector<VkImage> images_;
    enum class Image { Released, Acquired, Writable } image_ = Image::Released;
    std::uint32_t index_ = 0;  // of that image
};

}  // namespace foveray::xr
