#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <openxr/openxr.h>
#include <vulkan/vulkan.h>

#include "xr/simulator/handles.h"
#include "xr/simulator/vulkan_device.h"

namespace foveray::simulator {

class Session;

/// Formats that clients may choose, the best first.
std::span<const std::int64_t> swapchain_formats();
bool is_depth_format(VkFormat format);

/// Images on the client's device that go round: acquired, waited for, released, in that order.
class Swapchain : public Object {
  public:
    using Handle = XrSwapchain;
    static constexpr XrObjectType object_type = XR_OBJECT_TYPE_SWAPCHAIN;

    /// Refuses with XR_ERROR_FEATURE_UNSUPPORTED what the device cannot do.
    Swapchain(std::shared_ptr<Session> session, const XrSwapchainCreateInfo& info);

    const XrSwapchainCreateInfo& info() const { return info_; }
    VkFormat format() const { return static_cast<VkFormat>(info_.format); }
    std::vector<VkImage> images() const;
    /// The layout that images have whenever the client may touch them (XR_KHR_vulkan_enable2).
    VkImageLayout layout() const;
    VkImageAspectFlags aspect() const;

    // XR_ERROR_CALL_ORDER_INVALID out of order.
    std::uint32_t acquire();
    /// XR_TIMEOUT_EXPIRED when the script wants it; in real time, after so long.
    XrResult wait(XrDuration timeout);
    void release();
    /// What layers show: the image released last. Nothing before the first release.
    std::optional<std::uint32_t> shown() const;
    VkImage image(std::uint32_t index) const { return *images_[index].image; }
    /// Of one layer's largest mip level.
    VkImageView view(std::uint32_t index, std::uint32_t array_index);
    const Session& session() const { return *session_; }

  private:
    void bring_to_layout();

    std::shared_ptr<Session> session_;
    XrSwapchainCreateInfo info_;
    std::vector<VulkanDevice::Image> images_;

    mutable std::mutex mutex_;  // what follows
    std::map<std::pair<std::uint32_t, std::uint32_t>, VulkanOwned<VkImageView>> views_;
    std::uint64_t acquired_count_ = 0;    // ever
    std::deque<std::uint32_t> acquired_;  // not yet released, oldest first
    bool waited_ = false;                 // the oldest of them
    std::optional<std::uint32_t> shown_;
};

}  // namespace foveray::simulator
