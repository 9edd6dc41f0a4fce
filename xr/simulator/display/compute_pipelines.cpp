#include "xr/simulator/display/compute_pipelines.h"

#include <cassert>
#include <span>
#include <string>
#include <utility>

#include "shaders/shared/composition.h"

namespace foveray::simulator {

// Generated from shaders/simulator (cmake/foveray_shaders.cmake).
std::span<const std::pair<std::string_view, std::span<const std::uint32_t>>> embedded_shaders();

namespace {

constexpr auto buffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr auto picture = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;

VkDescriptorSetLayoutBinding binding(std::uint32_t number, VkDescriptorType type) {
    return {number, type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
}

std::span<const std::uint32_t> code_of(std::string_view shader) {
    for (const auto& [name, code] : embedded_shaders()) {
        if (name == shader) return code;
    }
    assert(false);
    return {};
}

}  // namespace

ComputePipelines::ComputePipelines(const VulkanDevice& device) : device_(device) {
    const auto& f = device.functions();
    VkSamplerCreateInfo sampler_info{};
    sampler_info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    sampler_info.magFilter = sampler_info.minFilter = VK_FILTER_LINEAR;
    sampler_info.addressModeU = VK_SAMPLER_ADDRESS_MODE_REPEAT;  // round environments; else unused
    sampler_info.addressModeV = sampler_info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler = VK_NULL_HANDLE;
    verify_vulkan(f.vkCreateSampler(device.handle(), &sampler_info, nullptr, &sampler), "vkCreateSampler");
    sampler_ = device.own(sampler, f.vkDestroySampler, VK_OBJECT_TYPE_SAMPLER, "simulator sampler");

    const VkDescriptorSetLayoutBinding bindings[] = {
        binding(shared::COMPOSITION_DRAWS, buffer), binding(shared::COMPOSITION_LIGHT, buffer),
        binding(shared::COMPOSITION_BYTES, buffer), binding(shared::COMPOSITION_SOURCE, picture),
        binding(shared::COMPOSITION_FOCUS, picture)};
    const VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                   nullptr, 0, std::size(bindings), bindings};
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    verify_vulkan(f.vkCreateDescriptorSetLayout(device.handle(), &set_info, nullptr, &set_layout),
                  "vkCreateDescriptorSetLayout");
    set_layout_ = device.own(set_layout, f.vkDestroyDescriptorSetLayout, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT,
                             "simulator descriptor set layout");

    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(std::uint32_t)};
    const VkPipelineLayoutCreateInfo layout_info{
        VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &set_layout, 1, &push};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    verify_vulkan(f.vkCreatePipelineLayout(device.handle(), &layout_info, nullptr, &layout),
                  "vkCreatePipelineLayout");
    layout_ = device.own(layout, f.vkDestroyPipelineLayout, VK_OBJECT_TYPE_PIPELINE_LAYOUT,
                         "simulator pipeline layout");
    pipelines_ = {create_pipeline("simulator/layer.comp"), create_pipeline("simulator/display.comp")};

    const VkDescriptorPoolSize sizes[] = {{buffer, 3 * max_dispatches}, {picture, 2 * max_dispatches}};
    const VkDescriptorPoolCreateInfo pool_info{
        VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, max_dispatches, std::size(sizes), sizes};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    verify_vulkan(f.vkCreateDescriptorPool(device.handle(), &pool_info, nullptr, &pool),
                  "vkCreateDescriptorPool");
    pool_ = device.own(pool, f.vkDestroyDescriptorPool, VK_OBJECT_TYPE_DESCRIPTOR_POOL,
                       "simulator descriptor pool");
}

VulkanOwned<VkPipeline> ComputePipelines::create_pipeline(std::string_view shader) const {
    const auto& f = device_.functions();
    const std::string name = "simulator " + std::string(shader);
    const std::span<const std::uint32_t> code = code_of(shader);
    const VkShaderModuleCreateInfo module_info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0,
                                               code.size_bytes(), code.data()};
    VkShaderModule made = VK_NULL_HANDLE;
    verify_vulkan(f.vkCreateShaderModule(device_.handle(), &module_info, nullptr, &made),
                  "vkCreateShaderModule");
    const auto module = device_.own(made, f.vkDestroyShaderModule, VK_OBJECT_TYPE_SHADER_MODULE, name);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = *module;
    info.stage.pName = "main";
    info.layout = *layout_;
    VkPipeline pipeline = VK_NULL_HANDLE;
    verify_vulkan(f.vkCreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                  "vkCreateComputePipelines");
    return device_.own(pipeline, f.vkDestroyPipeline, VK_OBJECT_TYPE_PIPELINE, name);
}

void ComputePipelines::reset() {
    verify_vulkan(device_.functions().vkResetDescriptorPool(device_.handle(), *pool_, 0),
                  "vkResetDescriptorPool");
}

void ComputePipelines::dispatch(VkCommandBuffer commands, Shader shader, const Bindings& bindings,
                                std::uint32_t draw, std::uint32_t width, std::uint32_t height) {
    const auto& f = device_.functions();
    const VkDescriptorSetLayout set_layout = *set_layout_;
    const VkDescriptorSetAllocateInfo allocate_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr,
                                                    *pool_, 1, &set_layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    verify_vulkan(f.vkAllocateDescriptorSets(device_.handle(), &allocate_info, &set),
                  "vkAllocateDescriptorSets");
    const auto image = [&](VkImageView view) {
        return VkDescriptorImageInfo{*sampler_, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    };
    const VkDescriptorImageInfo source = image(bindings.source), focus = image(bindings.focus);
    const auto write = [&](std::uint32_t number, VkDescriptorType type,
                           const VkDescriptorImageInfo* picture_info,
                           const VkDescriptorBufferInfo* buffer_info) {
        return VkWriteDescriptorSet{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                    nullptr,
                                    set,
                                    number,
                                    0,
                                    1,
                                    type,
                                    picture_info,
                                    buffer_info,
                                    nullptr};
    };
    const VkWriteDescriptorSet writes[] = {write(shared::COMPOSITION_DRAWS, buffer, nullptr, &bindings.draws),
                                           write(shared::COMPOSITION_LIGHT, buffer, nullptr, &bindings.light),
                                           write(shared::COMPOSITION_BYTES, buffer, nullptr, &bindings.bytes),
                                           write(shared::COMPOSITION_SOURCE, picture, &source, nullptr),
                                           write(shared::COMPOSITION_FOCUS, picture, &focus, nullptr)};
    f.vkUpdateDescriptorSets(device_.handle(), std::size(writes), writes, 0, nullptr);

    f.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                        *pipelines_[static_cast<std::size_t>(shader)]);
    f.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, *layout_, 0, 1, &set, 0, nullptr);
    f.vkCmdPushConstants(commands, *layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof draw, &draw);
    const auto groups = [](std::uint32_t pixels) {
        return (pixels + shared::COMPOSITION_GROUP - 1) / shared::COMPOSITION_GROUP;
    };
    f.vkCmdDispatch(commands, groups(width), groups(height), 1);
}

}  // namespace foveray::simulator
