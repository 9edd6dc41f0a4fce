#include "render/primary.h"

#include "shaders/shared/primary.h"
#include "shaders/shared/surface.h"

namespace foveray::render {
namespace {

constexpr std::uint32_t pixels_in_a_row = 1024;  // of the launch; views of any width share it

}  // namespace

PrimaryStage::PrimaryStage(const gpu::Device& device, const engine::SceneRayTracer& tracer,
                           engine::RayGeneration primary)
    : device_(device), tracer_(tracer), primary_(primary) {}

Surfaces PrimaryStage::record(const gpu::Commands& cmd, const SampleGrid& grid, std::uint32_t sub_sample,
                              vk::DeviceAddress counters) {
    using gpu::Access;
    const auto stage = cmd.stage("primary");
    const vk::DeviceSize size = vk::DeviceSize{grid.sample_count} * sizeof(shared::Surface);
    if (!surfaces_ || surfaces_.size() < size) {
        device_.vk().waitIdle();  // earlier frames still read what is replaced
        surfaces_ = gpu::Buffer(device_, "surfaces", size, gpu::Residence::Device);
    }
    for (const Access read : {Access::RayTracingRead, Access::ComputeRead}) {
        cmd.barrier(read, Access::RayTracingWrite);
    }
    const std::uint32_t row = grid.kind == shared::GRID_POLAR ? grid.polar.width : pixels_in_a_row;
    const shared::PrimaryPush push{grid.at(sub_sample), surfaces_.address(), counters, grid.sample_count,
                                   row};
    tracer_.trace(cmd, primary_, push, {row, (grid.sample_count + row - 1) / row, 1});
    cmd.barrier(Access::RayTracingWrite, Access::RayTracingRead);
    cmd.barrier(Access::RayTracingWrite, Access::ComputeRead);
    return {surfaces_.address(), grid.sample_count, &surfaces_};
}

}  // namespace foveray::render
