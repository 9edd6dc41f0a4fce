#pragma once

#include <filesystem>

#include "xr/simulator/display/background.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {

/// The background's picture on the GPU; a black pixel where it is a colour.
class BackgroundTexture {
  public:
    /// Throws Fault(BadInput) when the first picture cannot be read.
    BackgroundTexture(const VulkanDevice& device, const Background& background);

    const Background& background() const { return background_; }
    /// Before the GPU works for that frame, and while it does not work for another. Throws Fault(BadInput).
    void prepare(std::uint64_t frame);
    /// What `prepare` changed, to be read by later compute commands.
    void record(VkCommandBuffer commands);
    VkImageView view() const { return *view_; }

  private:
    void upload(const BackgroundPicture& picture);

    const VulkanDevice& device_;
    const Background& background_;
    std::filesystem::path shown_;
    VulkanDevice::Image image_;
    VulkanOwned<VkImageView> view_;
    uvec2 size_{0};
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    VulkanDevice::Buffer staging_;
    bool is_changed_ = false;
};

}  // namespace foveray::simulator
