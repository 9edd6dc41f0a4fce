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

/// Sizes are those of the object: only what differs between a scale's axes stays in the matrix, which never
/// lengthens, so that a distance in the part's space is never too long in the object's.
shared::BlendPart packed(const scene::BlendPart& part);

}  // namespace foveray::render
