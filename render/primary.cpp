#include "render/primary.h"

#include "render/grow.h"
#include "shaders/shared/primary.h"
#include "shaders/shared/surface.h"

namespace foveray::render {

PrimaryStage::PrimaryStage(const engine::SceneRayTracer& tracer, engine::RayGeneration primary)
    : tracer_(tracer), primary_(primary) {}

Surfaces PrimaryStage::record(const gpu::Commands& cmd, const SampleGrid& grid, std::uint32_t sub_sample,
                              vk::DeviceAddress counters) {
    using gpu::Access;
    const auto stage = cmd.stage("primary");
    const vk::DeviceSize size = vk::DeviceSize{grid.sample_count} * sizeof(shared::StoredSurface);
    grow(cmd, surfaces_, "surfaces", size);
    for (const Access read : {Access::RayTracingRead, Access::ComputeRead}) {
        cmd.barrier(read, Access::RayTracingWrite);
    }
    for (const SampleBlock& block : grid.blocks) {
        const shared::PrimaryPush push{grid.at(sub_sample), surfaces_.address(), counters, block.first, 0};
        tracer_.trace(cmd, primary_, push, {block.width, block.height, 1});
    }
    cmd.barrier(Access::RayTracingWrite, Access::RayTracingRead);
    cmd.barrier(Access::RayTracingWrite, Access::ComputeRead);
    return {surfaces_.address(), grid.sample_count, &surfaces_};
}

}  // namespace foveray::render
