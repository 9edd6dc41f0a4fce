#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <tuple>
#include <vector>

#include "render/gpu/memory.h"

namespace foveray::gpu {

struct SamplerInfo {
    vk::Filter mag = vk::Filter::eLinear;
    vk::Filter min = vk::Filter::eLinear;
    vk::SamplerMipmapMode mip = vk::SamplerMipmapMode::eLinear;
    bool use_mips = true;
    vk::SamplerAddressMode u = vk::SamplerAddressMode::eRepeat;
    vk::SamplerAddressMode v = vk::SamplerAddressMode::eRepeat;

    auto operator<=>(const SamplerInfo&) const = default;
};

/// Every texture that any shader samples, in one descriptor set (set 0, binding 0 of every pipeline): shaders
/// name a texture by its index. Images stay owned by whoever made them and must outlive their entry. Any
/// thread may add and remove.
class TextureTable {
  public:
    static constexpr std::uint32_t capacity = 4096;

    explicit TextureTable(const Device& device);

    /// The image must be in eShaderReadOnlyOptimal when it is sampled. Throws Fault(BadInput) when full.
    std::uint32_t add(vk::ImageView view, const SamplerInfo& sampler);
    /// Points an entry at another image; no submitted work may still use it.
    void replace(std::uint32_t index, vk::ImageView view, const SamplerInfo& sampler);
    void remove(std::uint32_t index);

    vk::DescriptorSetLayout layout() const { return *layout_; }
    vk::DescriptorSet set() const { return *set_; }

  private:
    void point(std::uint32_t index, vk::ImageView view, const SamplerInfo& sampler);
    vk::Sampler sampler(const SamplerInfo& info);

    const Device& device_;
    vk::raii::DescriptorSetLayout layout_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
    std::mutex mutex_;  // of what follows, and of writing to the set
    std::map<SamplerInfo, vk::raii::Sampler> samplers_;
    std::vector<std::uint32_t> free_;
    std::uint32_t used_ = 0;
};

}  // namespace foveray::gpu
