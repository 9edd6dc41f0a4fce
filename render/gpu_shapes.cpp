#include "render/gpu_shapes.h"

#include "render/gpu/acceleration.h"

namespace foveray::render {
namespace {

vk::AabbPositionsKHR box_of(const scene::Aabb& b) {
    return {b.min.x, b.min.y, b.min.z, b.max.x, b.max.y, b.max.z};
}

}  // namespace

GpuShapes::GpuShapes(gpu::Uploader& uploader, const scene::Scene& scene)
    : blends_(uploader, scene), solids_(uploader, scene), voxels_(uploader, scene) {
    std::vector<vk::AabbPositionsKHR> boxes;
    for (const scene::Shape& shape : scene.shapes) boxes.push_back(box_of(bounds_of(shape, shape.values)));
    if (!boxes.empty()) boxes_ = uploader.buffer("shape boxes", gpu::range_bytes(boxes), gpu::build_input);
}

vk::DeviceAddress GpuShapes::box(scene::ShapeId id) const {
    return boxes_.address() + id * sizeof(vk::AabbPositionsKHR);
}

void GpuShapes::record(const gpu::Commands& cmd, std::span<const scene::ShapeState> states) {
    bool any = false;
    for (scene::ShapeId id = 0; id < states.size(); ++id) {
        if (!states[id].changed) continue;
        if (!any) cmd.barrier(gpu::Access::AccelerationBuildInput, gpu::Access::TransferWrite);
        any = true;
        const vk::AabbPositionsKHR box = box_of(states[id].bounds);
        cmd->updateBuffer<vk::AabbPositionsKHR>(boxes_.vk(), id * sizeof box, box);
    }
    if (any) cmd.barrier(gpu::Access::TransferWrite, gpu::Access::AccelerationBuildInput);
}

}  // namespace foveray::render
