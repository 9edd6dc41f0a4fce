#pragma once

#include <span>

#include "render/gpu/commands.h"
#include "render/gpu_blends.h"
#include "render/gpu_solids.h"
#include "render/gpu_voxels.h"
#include "render/scene/animator.h"

namespace foveray::render {

/// What the scene's shapes need on the GPU besides their records: the boxes that bound them, and what is too
/// long for a record.
class GpuShapes {
  public:
    /// The scene must outlive this.
    GpuShapes(gpu::Uploader& uploader, const scene::Scene& scene);

    /// VkAabbPositionsKHR of the shape, object space.
    vk::DeviceAddress box(scene::ShapeId id) const;

    /// Brings the boxes of changed shapes up to date. Orders itself after earlier frames' builds and before
    /// later ones.
    void record(const gpu::Commands& cmd, std::span<const scene::ShapeState> states);

    const GpuBlends& blends() const { return blends_; }
    const GpuSolids& solids() const { return solids_; }
    const GpuVoxels& voxels() const { return voxels_; }

  private:
    gpu::Buffer boxes_;
    GpuBlends blends_;
    GpuSolids solids_;
    GpuVoxels voxels_;
};

}  // namespace foveray::render
