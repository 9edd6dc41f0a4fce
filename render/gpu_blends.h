#pragma once

#include <vector>

#include "render/gpu/commands.h"
#include "render/scene/scene.h"
#include "shaders/shared/shapes.h"

namespace foveray::render {

/// The parts of a scene's blend shapes on the GPU.
class GpuBlends {
  public:
    GpuBlends(gpu::Uploader& uploader, const scene::Scene& scene);

    /// Of the shape that the header names.
    shared::BlendRecord record(const shared::ShapeHeader& header, float smoothness,
                               const scene::Aabb& bounds) const;

  private:
    struct Place {
        std::uint32_t first = 0, count = 0;
    };

    std::vector<Place> places_;  // by shape id
    gpu::Buffer parts_;
};

}  // namespace foveray::render
