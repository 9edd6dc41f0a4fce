#pragma once

#include <vector>

#include "render/gpu/commands.h"
#include "render/scene/scene.h"
#include "shaders/shared/shapes.h"

namespace foveray::render {

/// The leaves and programs of a scene's csg shapes on the GPU.
class GpuSolids {
  public:
    GpuSolids(gpu::Uploader& uploader, const scene::Scene& scene);

    /// Of the shape that the header names.
    shared::CsgRecord record(const shared::ShapeHeader& header) const;

  private:
    struct Place {
        std::uint32_t first_leaf = 0, leaf_count = 0, first_step = 0, step_count = 0;
    };

    std::vector<Place> places_;  // by shape id
    gpu::Buffer leaves_, steps_;
};

}  // namespace foveray::render
