#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "render/gpu/commands.h"
#include "render/gpu/texture_table.h"

namespace foveray::gpu {

/// The shaders that run where a ray meets a geometry: names as in gpu::shader(), or of shaders that came with
/// the pipeline's info; each may be empty. With an intersection shader the group is for boxes, without it for
/// triangles.
struct HitGroup {
    std::string closest_hit, any_hit, intersection;

    auto operator<=>(const HitGroup&) const = default;
};

struct RayTracingPipelineInfo {
    std::string name;
    std::vector<std::string> ray_generation;  // shader names
    std::vector<std::string> miss;            // shader names
    std::vector<HitGroup> hit_groups;
    std::map<std::string, std::vector<std::uint32_t>> own_shaders = {};  // SPIR-V made at run time, by name
};

/// Ray-generation, miss and hit shaders as one pipeline. Set 0 is the texture table, set 1 the acceleration
/// structure (binding 0); 128 bytes of push constants are seen by every stage. Rays are only traced from
/// ray-generation shaders: the recursion depth is 1.
class RayTracingPipeline {
  public:
    static constexpr std::uint32_t push_size = 128;
    static constexpr vk::ShaderStageFlags stages =
        vk::ShaderStageFlagBits::eRaygenKHR | vk::ShaderStageFlagBits::eMissKHR |
        vk::ShaderStageFlagBits::eClosestHitKHR | vk::ShaderStageFlagBits::eAnyHitKHR |
        vk::ShaderStageFlagBits::eIntersectionKHR;

    RayTracingPipeline(const Device& device, const RayTracingPipelineInfo& info, const TextureTable& textures,
                       vk::DescriptorSetLayout acceleration);

    vk::Pipeline vk() const { return *pipeline_; }
    vk::PipelineLayout layout() const { return *layout_; }

    /// Opaque bytes that start a shader table's record; indices as in the info.
    std::span<const std::byte> ray_generation_handle(std::uint32_t index) const;
    std::span<const std::byte> miss_handle(std::uint32_t index) const;
    std::span<const std::byte> hit_handle(std::uint32_t index) const;

  private:
    std::span<const std::byte> handle(std::size_t group) const;

    std::size_t ray_generation_count_ = 0, miss_count_ = 0;
    std::size_t handle_size_ = 0;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::Pipeline pipeline_ = nullptr;
    std::vector<std::byte> handles_;
};

}  // namespace foveray::gpu
