#pragma once

#include <vector>

#include "render/gpu/memory.h"
#include "shaders/shared/view_image.h"

namespace foveray::render {

/// The pictures of a frame, by view as in Frame::views. The buffers belong to the resolve stage. What lies
/// between resolve and compositor has room for one view at a time.
struct ViewImages {
    struct Buffers {
        const gpu::Buffer* color = nullptr;  // for the compositor to fill
        const gpu::Buffer* depth = nullptr;
    };
    std::vector<shared::ViewImage> images;
    std::vector<Buffers> buffers;           // parallel to images
    const gpu::Buffer* resolved = nullptr;  // shared::ResolvedPixel
    const gpu::Buffer* real = nullptr;      // shared::ResolvedRealPixel, or null
};

}  // namespace foveray::render
