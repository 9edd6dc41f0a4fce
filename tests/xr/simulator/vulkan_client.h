#pragma once

#include <array>
#include <cstdint>
#include <memory>

// OpenXR's platform header needs Vulkan's types before it.
// clang-format off
#include <ctime>
#include <vulkan/vulkan.h>
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
// clang-format on

namespace foveray::simulator_tests {

using Color = std::array<std::uint8_t, 4>;  // bytes as they lie in memory

enum class VulkanEnable { First, Second };

/// A Vulkan device with the validation layer, each of whose messages fails the test: made through
/// XR_KHR_vulkan_enable2, or by the client itself as XR_KHR_vulkan_enable wants it.
class VulkanClient {
  public:
    explicit VulkanClient(XrInstance instance, VulkanEnable enable = VulkanEnable::Second);
    ~VulkanClient();

    const XrGraphicsBindingVulkanKHR& binding() const;
    /// Fills a rectangle of a colour image that is in VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, and waits.
    void fill(VkImage image, std::uint32_t layer, VkRect2D rect, Color color);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace foveray::simulator_tests
