#include "render/ray_counters.h"

#include <string>

#include "shaders/shared/ray_log.h"

namespace foveray::render {

using gpu::Access;

RayCounters::RayCounters(const gpu::Device& device, std::uint32_t slots)
    : counters_(device, "ray counters",
                sizeof(std::uint32_t) * shared::RAY_LOG_ADDRESS_AT + sizeof(vk::DeviceAddress),
                gpu::Residence::Device) {
    for (std::uint32_t i = 0; i < slots; ++i) {
        slots_.emplace_back(device, "ray counters read back " + std::to_string(i), counters_.size(),
                            gpu::Residence::Readback);
    }
}

void RayCounters::clear(const gpu::Commands& cmd, vk::DeviceAddress log) const {
    cmd.barrier(Access::RayTracingWrite, Access::TransferWrite);
    cmd.barrier(Access::TransferRead, Access::TransferWrite);
    const vk::DeviceSize counters = sizeof(std::uint32_t) * shared::RAY_LOG_ADDRESS_AT;
    cmd->fillBuffer(counters_.vk(), 0, counters, 0);
    cmd->updateBuffer<vk::DeviceAddress>(counters_.vk(), counters, log);
    cmd.barrier(Access::TransferWrite, Access::RayTracingWrite);
}

void RayCounters::read_back(const gpu::Commands& cmd, std::uint32_t slot) const {
    cmd.barrier(Access::RayTracingWrite, Access::TransferRead);
    cmd->copyBuffer(counters_.vk(), slots_[slot].vk(), vk::BufferCopy(0, 0, counters_.size()));
    cmd.barrier(Access::TransferWrite, Access::HostRead);
}

RayCounts RayCounters::counts(std::uint32_t slot) const {
    slots_[slot].invalidate();
    RayCounts counts{};
    const auto values = slots_[slot].mapped_as<std::uint32_t>();
    for (std::size_t i = 0; i < shared::RAY_LOG_ADDRESS_AT; ++i)
        counts[i / shared::RAY_COUNTER_SLOTS] += values[i];
    return counts;
}

}  // namespace foveray::render
