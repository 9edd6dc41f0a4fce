#include "render/gpu/texture_table.h"

#include "base/error.h"

namespace foveray::gpu {

TextureTable::TextureTable(const Device& device) : device_(device) {
    using Flag = vk::DescriptorBindingFlagBits;
    const vk::DescriptorBindingFlags flags =
        Flag::ePartiallyBound | Flag::eUpdateAfterBind | Flag::eUpdateUnusedWhilePending;
    const vk::DescriptorSetLayoutBindingFlagsCreateInfo binding_flags(flags);
    const vk::DescriptorSetLayoutBinding binding(0, vk::DescriptorType::eCombinedImageSampler, capacity,
                                                 vk::ShaderStageFlagBits::eAll);
    layout_ = vk::raii::DescriptorSetLayout(
        device.vk(),
        vk::DescriptorSetLayoutCreateInfo(vk::DescriptorSetLayoutCreateFlagBits::eUpdateAfterBindPool,
                                          binding, &binding_flags));
    device.set_name(*layout_, "texture table layout");
    const vk::DescriptorPoolSize size(vk::DescriptorType::eCombinedImageSampler, capacity);
    pool_ = vk::raii::DescriptorPool(
        device.vk(), vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eUpdateAfterBind |
                                                      vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                                  1, size));
    device.set_name(*pool_, "texture table pool");
    auto sets = vk::raii::DescriptorSets(device.vk(), vk::DescriptorSetAllocateInfo(*pool_, *layout_));
    set_ = std::move(sets.front());
    device.set_name(*set_, "texture table");
}

std::uint32_t TextureTable::add(vk::ImageView view, const SamplerInfo& info) {
    const std::lock_guard lock(mutex_);
    std::uint32_t index = used_;
    if (!free_.empty()) {
        index = free_.back();
        free_.pop_back();
    } else if (used_ == capacity) {
        throw_bad_input("textures", "the scene has more than " + std::to_string(capacity) + " textures",
                        "use fewer, or share images and samplers");
    } else {
        ++used_;
    }
    point(index, view, info);
    return index;
}

void TextureTable::replace(std::uint32_t index, vk::ImageView view, const SamplerInfo& info) {
    const std::lock_guard lock(mutex_);
    point(index, view, info);
}

void TextureTable::remove(std::uint32_t index) {
    const std::lock_guard lock(mutex_);
    free_.push_back(index);
}

void TextureTable::point(std::uint32_t index, vk::ImageView view, const SamplerInfo& info) {
    const vk::DescriptorImageInfo image(sampler(info), view, vk::ImageLayout::eShaderReadOnlyOptimal);
    device_.vk().updateDescriptorSets(
        vk::WriteDescriptorSet(*set_, 0, index, vk::DescriptorType::eCombinedImageSampler, image), {});
}

vk::Sampler TextureTable::sampler(const SamplerInfo& info) {
    const auto it = samplers_.find(info);
    if (it != samplers_.end()) return *it->second;
    vk::SamplerCreateInfo create({}, info.mag, info.min, info.mip, info.u, info.v);
    create.maxLod = VK_LOD_CLAMP_NONE;
    if (!info.use_mips) {  // level 0 only, but minified where it is: VkSamplerCreateInfo, on GL_NEAREST and
                           // GL_LINEAR
        create.mipmapMode = vk::SamplerMipmapMode::eNearest;
        create.maxLod = 0.25f;
    }
    vk::raii::Sampler sampler(device_.vk(), create);
    device_.set_name(*sampler, "sampler " + std::to_string(samplers_.size()));
    return *samplers_.emplace(info, std::move(sampler)).first->second;
}

}  // namespace foveray::gpu
