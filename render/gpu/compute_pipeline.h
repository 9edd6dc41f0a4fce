#pragma once

#include <cstdint>
#include <string_view>

#include "render/gpu/commands.h"
#include "render/gpu/texture_table.h"

namespace foveray::gpu {

/// A compute shader whose inputs are push constants (mostly buffer addresses) and the texture table as set 0.
class ComputePipeline {
  public:
    /// `shader_name` as in gpu::shader(); `push_size` in bytes.
    ComputePipeline(const Device& device, std::string_view shader_name, const TextureTable& textures,
                    std::uint32_t push_size);
    /// From SPIR-V made at run time.
    ComputePipeline(const Device& device, const std::string& name, std::span<const std::uint32_t> code,
                    const TextureTable& textures, std::uint32_t push_size);

    /// Binds, pushes and dispatches enough groups of `group` threads to cover `threads`.
    template <typename Push>
    void dispatch(const Commands& cmd, const Push& push, vk::Extent3D threads, vk::Extent3D group) const {
        dispatch(cmd, bytes_of(push), threads, group);
    }

  private:
    void dispatch(const Commands& cmd, std::span<const std::byte> push, vk::Extent3D threads,
                  vk::Extent3D group) const;

    vk::DescriptorSet textures_;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::Pipeline pipeline_ = nullptr;
};

}  // namespace foveray::gpu
