#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "xr/simulator/api/limits.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {

/// The compositor's shaders (shaders/simulator) on the client's device, which may be Vulkan 1.0 without any
/// feature.
class ComputePipelines {
  public:
    enum class Shader { Layer, Display };
    /// What a dispatch reads and writes; bindings as in shaders/shared/composition.h.
    struct Bindings {
        VkDescriptorBufferInfo draws{}, light{}, bytes{};
        VkImageView source = VK_NULL_HANDLE, focus = VK_NULL_HANDLE;
    };

    explicit ComputePipelines(const VulkanDevice& device);

    /// Forgets the dispatches recorded so far, which the GPU has finished.
    void reset();
    /// One thread a pixel; `draw` is the index in the draws. At most max_dispatches after each reset.
    void dispatch(VkCommandBuffer commands, Shader shader, const Bindings& bindings, std::uint32_t draw,
                  std::uint32_t width, std::uint32_t height);

    static constexpr std::uint32_t max_dispatches = 2 * (max_layers + 1);  // layers and background, each eye

  private:
    VulkanOwned<VkPipeline> create_pipeline(std::string_view shader) const;

    const VulkanDevice& device_;
    VulkanOwned<VkSampler> sampler_;
    VulkanOwned<VkDescriptorSetLayout> set_layout_;
    VulkanOwned<VkPipelineLayout> layout_;
    std::array<VulkanOwned<VkPipeline>, 2> pipelines_;  // by Shader
    VulkanOwned<VkDescriptorPool> pool_;
};

}  // namespace foveray::simulator
