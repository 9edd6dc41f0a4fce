#include "render/gpu_voxels.h"

namespace foveray::render {

GpuVoxels::GpuVoxels(gpu::Uploader& uploader, const scene::Scene& scene) {
    for (const scene::Shape& shape : scene.shapes) {
        if (!shape.voxels) continue;
        const auto [tree, is_new] = trees_.try_emplace(shape.voxels.get());
        if (!is_new) continue;
        tree->second.links =
            uploader.buffer(shape.name + " voxel links", gpu::range_bytes(shape.voxels->links));
        tree->second.nodes =
            uploader.buffer(shape.name + " voxel nodes", gpu::range_bytes(shape.voxels->nodes));
    }
}

shared::VoxelRecord GpuVoxels::record(const shared::ShapeHeader& header, const scene::Voxels& voxels) const {
    const Tree& tree = trees_.at(&voxels);
    shared::VoxelRecord record{};
    record.shape = header;
    record.links = tree.links.address();
    record.nodes = tree.nodes.address();
    record.origin = voxels.origin;
    record.voxel_size = voxels.voxel_size;
    record.box_min = voxels.box_min;
    record.depth = voxels.depth;
    record.box_max = voxels.box_max;
    record.flags = voxels.show_faces ? shared::VOXELS_SHOW_FACES : 0;
    return record;
}

}  // namespace foveray::render
