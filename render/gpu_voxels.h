#pragma once

#include <map>

#include "render/gpu/commands.h"
#include "render/scene/scene.h"
#include "shaders/shared/voxels.h"

namespace foveray::render {

/// The octrees of a scene's voxel objects on the GPU, each once.
class GpuVoxels {
  public:
    GpuVoxels(gpu::Uploader& uploader, const scene::Scene& scene);

    shared::VoxelRecord record(const shared::ShapeHeader& header, const scene::Voxels& voxels) const;

  private:
    struct Tree {
        gpu::Buffer links, nodes;
    };
    std::map<const scene::Voxels*, Tree> trees_;  // only looked up
};

}  // namespace foveray::render
