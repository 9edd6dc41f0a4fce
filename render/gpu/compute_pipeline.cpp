#include "render/gpu/compute_pipeline.h"

#include <cassert>

#include "render/gpu/shader_library.h"

namespace foveray::gpu {

ComputePipeline::ComputePipeline(const Device& device, std::string_view shader_name,
                                 const TextureTable& textures, std::uint32_t push_size)
    : ComputePipeline(device, std::string(shader_name), shader(shader_name), textures, push_size) {}

ComputePipeline::ComputePipeline(const Device& device, const std::string& name,
                                 std::span<const std::uint32_t> code, const TextureTable& textures,
                                 std::uint32_t push_size)
    : textures_(textures.set()) {
    const vk::raii::ShaderModule module(device.vk(), {{}, code.size_bytes(), code.data()});
    device.set_name(*module, name);
    const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, push_size);
    const vk::DescriptorSetLayout set_layout = textures.layout();
    layout_ = vk::raii::PipelineLayout(device.vk(), vk::PipelineLayoutCreateInfo({}, set_layout, range));
    device.set_name(*layout_, name + " layout");
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
    pipeline_ = vk::raii::Pipeline(device.vk(), nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout_));
    device.set_name(*pipeline_, name);
}

void ComputePipeline::dispatch(const Commands& cmd, std::span<const std::byte> push, vk::Extent3D threads,
                               vk::Extent3D group) const {
    cmd->bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    cmd->bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, textures_, {});
    cmd->pushConstants<std::byte>(
        *layout_, vk::ShaderStageFlagBits::eCompute, 0,
        vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    const auto groups = [](std::uint32_t n, std::uint32_t size) { return (n + size - 1) / size; };
    cmd->dispatch(groups(threads.width, group.width), groups(threads.height, group.height),
                  groups(threads.depth, group.depth));
}

}  // namespace foveray::gpu
