#include "render/gpu/barriers.h"

namespace foveray::gpu {

AccessScope scope_of(Access access) {
    using Stage = vk::PipelineStageFlagBits2;
    using Flag = vk::AccessFlagBits2;
    switch (access) {
        case Access::None:
            return {Stage::eNone, Flag::eNone};
        case Access::HostWrite:
            return {Stage::eHost, Flag::eHostWrite};
        case Access::HostRead:
            return {Stage::eHost, Flag::eHostRead};
        case Access::TransferRead:
            return {Stage::eTransfer, Flag::eTransferRead};
        case Access::TransferWrite:
            return {Stage::eTransfer, Flag::eTransferWrite};
        case Access::ComputeRead:
            return {Stage::eComputeShader, Flag::eShaderRead};
        case Access::ComputeWrite:
            return {Stage::eComputeShader, Flag::eShaderRead | Flag::eShaderWrite};
        case Access::RayTracingRead:
            return {Stage::eRayTracingShaderKHR, Flag::eShaderRead | Flag::eAccelerationStructureReadKHR};
        case Access::RayTracingWrite:
            return {Stage::eRayTracingShaderKHR, Flag::eShaderRead | Flag::eShaderWrite};
        case Access::AccelerationBuildInput:
            return {Stage::eAccelerationStructureBuildKHR, Flag::eShaderRead};
        case Access::AccelerationBuildWrite:
            return {Stage::eAccelerationStructureBuildKHR,
                    Flag::eAccelerationStructureReadKHR | Flag::eAccelerationStructureWriteKHR};
        case Access::AccelerationBuildRead:
            return {Stage::eAccelerationStructureBuildKHR, Flag::eAccelerationStructureReadKHR};
        case Access::IndirectRead:
            return {Stage::eDrawIndirect, Flag::eIndirectCommandRead};
        case Access::FragmentSampledRead:
            return {Stage::eFragmentShader, Flag::eShaderRead};
        case Access::ColorAttachment:
            return {Stage::eColorAttachmentOutput, Flag::eColorAttachmentRead | Flag::eColorAttachmentWrite};
        case Access::DepthAttachment:
            return {Stage::eEarlyFragmentTests | Stage::eLateFragmentTests,
                    Flag::eDepthStencilAttachmentRead | Flag::eDepthStencilAttachmentWrite};
    }
    return {};
}

void barrier(const vk::raii::CommandBuffer& cmd, Access from, Access to) {
    const AccessScope source = scope_of(from), target = scope_of(to);
    const vk::MemoryBarrier2 memory(source.stages, source.access, target.stages, target.access);
    cmd.pipelineBarrier2(vk::DependencyInfo({}, memory));
}

void transition(const vk::raii::CommandBuffer& cmd, vk::Image image, Access from, vk::ImageLayout from_layout,
                Access to, vk::ImageLayout to_layout, vk::ImageAspectFlags aspect, std::uint32_t base_mip,
                std::uint32_t mip_count) {
    const AccessScope source = scope_of(from), target = scope_of(to);
    const vk::ImageMemoryBarrier2 memory(source.stages, source.access, target.stages, target.access,
                                         from_layout, to_layout, VK_QUEUE_FAMILY_IGNORED,
                                         VK_QUEUE_FAMILY_IGNORED, image,
                                         {aspect, base_mip, mip_count, 0, VK_REMAINING_ARRAY_LAYERS});
    cmd.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, memory));
}

}  // namespace foveray::gpu
