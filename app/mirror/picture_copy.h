#pragma once

#include "app/mirror/picture_layout.h"
#include "render/gpu/commands.h"

namespace foveray::app {

/// Puts a picture that lies in a buffer into a rectangle of an image, averaged down or interpolated up.
class PictureCopy {
  public:
    /// `source`: tightly packed sRGB-encoded RGBA8, complete for Access::TransferRead. `target` is in
    /// eTransferDstOptimal with extent `bounds`; `place`, in pixels, is clipped to it. The caller orders
    /// accesses to `target`, and the work of an earlier call is done.
    void record(const gpu::Commands& cmd, vk::Buffer source, vk::DeviceSize offset, uvec2 size,
                vk::Image target, vk::Extent2D bounds, const Rect& place);

  private:
    gpu::Image image_;
};

}  // namespace foveray::app
