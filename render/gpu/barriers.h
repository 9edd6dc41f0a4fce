#pragma once

#include "render/gpu/vulkan.h"

namespace foveray::gpu {

/// What a command does with memory. One word a use, so that every barrier reads as "from, to".
enum class Access {
    None,
    HostWrite,
    HostRead,
    TransferRead,
    TransferWrite,
    ComputeRead,
    ComputeWrite,
    RayTracingRead,
    RayTracingWrite,
    AccelerationBuildInput,  // vertices, indices, instances read by a build
    AccelerationBuildWrite,  // the structure and its scratch memory
    AccelerationBuildRead,   // a structure that a build, copy or query reads
    IndirectRead,           // sizes of a launch
    FragmentSampledRead,
    ColorAttachment,
    DepthAttachment,
};

struct AccessScope {
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 access;
};

/// The table behind the barriers below; tests check it row by row, because the validation layers do not track
/// acceleration structure builds and traces.
AccessScope scope_of(Access access);

/// Memory barrier over all buffers and acceleration structures: what `from` wrote, `to` sees.
void barrier(const vk::raii::CommandBuffer& cmd, Access from, Access to);
/// Moves all levels of a colour or depth image to the layout that `to_layout` names and orders the accesses.
/// `from_layout` eUndefined discards the contents.
void transition(const vk::raii::CommandBuffer& cmd, vk::Image image, Access from, vk::ImageLayout from_layout,
                Access to, vk::ImageLayout to_layout,
                vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor, std::uint32_t base_mip = 0,
                std::uint32_t mip_count = VK_REMAINING_MIP_LEVELS);

}  // namespace foveray::gpu
