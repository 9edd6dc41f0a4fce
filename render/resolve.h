#pragma once

#include <array>
#include <span>

#include "base/settings.h"
#include "base/view.h"
#include "render/gpu/compute_pipeline.h"
#include "render/lighting.h"
#include "render/sampling.h"
#include "render/view_images.h"

namespace foveray::render {

/// Turns samples into each view's pixels. Polar samples are interpolated where they are coarser than pixels
/// and averaged where they are finer; per-pixel samples are copied. Depth is the nearest sample's.
class ResolveStage {
  public:
    ResolveStage(const gpu::Device& device, const gpu::TextureTable& textures);

    /// Room for the frame's pictures. `layers`: Scene::changes_what_is_behind.
    ViewImages images(const gpu::Commands& cmd, std::span<const View> views, bool layers);
    /// One view of those that the grid was made for. Compute shaders recorded afterwards see it, until the
    /// next view is resolved.
    void record(const gpu::Commands& cmd, const LightLayers& light, const SampleGrid& grid,
                const ViewImages& images, std::size_t view, const Settings& settings);

  private:
    struct Buffers {
        gpu::Buffer color, depth;
    };
    gpu::ComputePipeline pipeline_;
    gpu::Buffer resolved_, real_;
    std::array<Buffers, shared::MAX_VIEWS> buffers_;
};

}  // namespace foveray::render
