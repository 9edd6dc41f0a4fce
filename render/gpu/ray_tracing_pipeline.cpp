#include "render/gpu/ray_tracing_pipeline.h"

#include <array>
#include <cassert>
#include <map>
#include <utility>

#include "render/gpu/shader_library.h"

namespace foveray::gpu {
namespace {

/// The pipeline's stages and their code.
class Stages {
  public:
    Stages(const Device& device, const RayTracingPipelineInfo& info) : device_(device), info_(info) {}

    std::uint32_t index(vk::ShaderStageFlagBits stage, const std::string& name) {
        if (name.empty()) return VK_SHADER_UNUSED_KHR;
        const auto [it, is_new] = indices_.try_emplace(name);
        if (is_new) it->second = add_stage(stage, module(name));
        return it->second;
    }
    /// A stage of its own for each group. Lavapipe 25 joins an intersection shader with its group's any-hit
    /// shader, once a stage: a group that shared the stage would run the other group's any-hit shader.
    std::uint32_t intersection(const std::string& name) {
        return name.empty() ? VK_SHADER_UNUSED_KHR
                            : add_stage(vk::ShaderStageFlagBits::eIntersectionKHR, module(name));
    }

    std::vector<vk::PipelineShaderStageCreateInfo> infos;

  private:
    vk::ShaderModule module(const std::string& name) {
        const auto [it, is_new] = modules_.try_emplace(name, nullptr);
        if (is_new) {
            const auto code = code_of(name);
            it->second = vk::raii::ShaderModule(
                device_.vk(), vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
            device_.set_name(*it->second, name);
        }
        return *it->second;
    }
    std::uint32_t add_stage(vk::ShaderStageFlagBits stage, vk::ShaderModule code) {
        infos.emplace_back(vk::PipelineShaderStageCreateFlags{}, stage, code, "main");
        return static_cast<std::uint32_t>(infos.size() - 1);
    }
    std::span<const std::uint32_t> code_of(const std::string& name) const {
        const auto own = info_.own_shaders.find(name);
        return own == info_.own_shaders.end() ? shader(name) : std::span(own->second);
    }

    const Device& device_;
    const RayTracingPipelineInfo& info_;
    std::map<std::string, vk::raii::ShaderModule> modules_;
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
    Stages used(device, info);
    std::vector<vk::RayTracingShaderGroupCreateInfoKHR> groups;
    using Stage = vk::ShaderStageFlagBits;
    for (const std::string& name : info.ray_generation) {
        groups.push_back(general_group(used.index(Stage::eRaygenKHR, name)));
    }
    for (const std::string& name : info.miss)
        groups.push_back(general_group(used.index(Stage::eMissKHR, name)));
    for (const HitGroup& group : info.hit_groups) {
        groups.emplace_back(
            group.intersection.empty() ? vk::RayTracingShaderGroupTypeKHR::eTrianglesHitGroup
                                       : vk::RayTracingShaderGroupTypeKHR::eProceduralHitGroup,
            VK_SHADER_UNUSED_KHR, used.index(Stage::eClosestHitKHR, group.closest_hit),
            used.index(Stage::eAnyHitKHR, group.any_hit), used.intersection(group.intersection));
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
