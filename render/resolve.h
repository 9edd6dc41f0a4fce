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

    /// `views` as the grid was made for; `layers`: Scene::changes_what_is_behind. Compute shaders recorded
    /// afterwards see the result.
    ViewImages record(const gpu::Commands& cmd, const LightLayers& light, const SampleGrid& grid,
                      std::span<const View> views, bool layers, const Settings& settings);

  private:
    struct Buffers {
        gpu::Buffer resolved, real, color, depth;
    };
    gpu::ComputePipeline pipeline_;
    std::array<Buffers, shared::MAX_VIEWS> buffers_;
};

}  // namespace foveray::render
