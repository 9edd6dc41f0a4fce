#include "render/gpu/ray_tracing_pipeline.h"

#include <array>
#include <cassert>
#include <map>
#include <utility>

#include "render/gpu/shader_library.h"

namespace foveray::gpu {
namespace {

/// The pipeline's stages, each shader once.
class Stages {
  public:
    explicit Stages(const Device& device) : device_(device) {}

    std::uint32_t index(vk::ShaderStageFlagBits stage, const std::string& name) {
        if (name.empty()) return VK_SHADER_UNUSED_KHR;
        const auto [it, is_new] = indices_.emplace(name, static_cast<std::uint32_t>(infos.size()));
        if (is_new) {
            const auto code = shader(name);
            modules_.emplace_back(device_.vk(),
                                  vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
            device_.set_name(*modules_.back(), name);
            infos.emplace_back(vk::PipelineShaderStageCreateFlags{}, stage, *modules_.back(), "main");
        }
        return it->second;
    }

    std::vector<vk::PipelineShaderStageCreateInfo> infos;

  private:
    const Device& device_;
    std::vector<vk::raii::ShaderModule> modules_;
    std::map<std::string, std::uint32_t> indices_;
};

vk::RayTracingShaderGroupCreateInfoKHR general_group(std::uint32_t stage) {
    return {vk::RayTracingShaderGroupTypeKHR::eGeneral, stage, VK_SHADER_UNUSED_KHR, VK_SHADER_UNUSED_KHR,
            VK_SHADER_UNUSED_KHR};
}

}  // namespace

RayTracingPipeline::RayTracingPipeline(const Device& device, const RayTracingPipelineInfo& info,
                                       const TextureTable& textures, vk::DescriptorSetLayout acceleration)
    : ray_generation_count_(info.ray_generation.size()),
      miss_count_(info.miss.size()),
      handle_size_(device.limits().handle_size) {
    Stages used(device);
    std::vector<vk::RayTracingShaderGroupCreateInfoKHR> groups;
    using Stage = vk::ShaderStageFlagBits;
    for (const std::string& name : info.ray_generation) {
        groups.push_back(general_group(used.index(Stage::eRaygenKHR, name)));
    }
    for (const std::string& name : info.miss)
        groups.push_back(general_group(used.index(Stage::eMissKHR, name)));
    for (const HitGroup& group : info.hit_groups) {
        groups.emplace_back(group.intersection.empty()
                                ? vk::RayTracingShaderGroupTypeKHR::eTrianglesHitGroup
                                : vk::RayTracingShaderGroupTypeKHR::eProceduralHitGroup,
                            VK_SHADER_UNUSED_KHR, used.index(Stage::eClosestHitKHR, group.closest_hit),
                            used.index(Stage::eAnyHitKHR, group.any_hit),
                            used.index(Stage::eIntersectionKHR, group.intersection));
    }

    const std::array set_layouts = {textures.layout(), acceleration};
    const vk::PushConstantRange range(RayTracingPipeline::stages, 0, push_size);
    layout_ = vk::raii::PipelineLayout(device.vk(), vk::PipelineLayoutCreateInfo({}, set_layouts, range));
    device.set_name(*layout_, info.name + " layout");
    constexpr std::uint32_t recursion_depth = 1;
    pipeline_ = vk::raii::Pipeline(
        device.vk(), nullptr, nullptr,
        vk::RayTracingPipelineCreateInfoKHR({}, used.infos, groups, recursion_depth, {}, {}, {}, *layout_));
    device.set_name(*pipeline_, info.name);
    handles_ = pipeline_.getRayTracingShaderGroupHandlesKHR<std::byte>(
        0, static_cast<std::uint32_t>(groups.size()), groups.size() * handle_size_);
}

std::span<const std::byte> RayTracingPipeline::handle(std::size_t group) const {
    assert((group + 1) * handle_size_ <= handles_.size());
    return std::span(handles_).subspan(group * handle_size_, handle_size_);
}

std::span<const std::byte> RayTracingPipeline::ray_generation_handle(std::uint32_t index) const {
    return handle(index);
}

std::span<const std::byte> RayTracingPipeline::miss_handle(std::uint32_t index) const {
    return handle(ray_generation_count_ + index);
}

std::span<const std::byte> RayTracingPipeline::hit_handle(std::uint32_t index) const {
    return handle(ray_generation_count_ + miss_count_ + index);
}

}  // namespace foveray::gpu
