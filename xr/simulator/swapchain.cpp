#include "xr/simulator/swapchain.h"

#include <chrono>
#include <string>
#include <thread>

#include "xr/simulator/session.h"

namespace foveray::simulator {
namespace {

VkImageUsageFlags vulkan_usage(XrSwapchainUsageFlags usage) {
    constexpr std::pair<XrSwapchainUsageFlags, VkImageUsageFlags> table[] = {
        {XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT},
        {XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT},
        {XR_SWAPCHAIN_USAGE_UNORDERED_ACCESS_BIT, VK_IMAGE_USAGE_STORAGE_BIT},
        {XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT, VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
        {XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT, VK_IMAGE_USAGE_TRANSFER_DST_BIT},
        {XR_SWAPCHAIN_USAGE_SAMPLED_BIT, VK_IMAGE_USAGE_SAMPLED_BIT},
    };
    VkImageUsageFlags flags = 0;
    for (const auto& [xr, vulkan] : table) {
        if (usage & xr) flags |= vulkan;
    }
    return flags;
}

VkImageCreateInfo image_info(const XrSwapchainCreateInfo& info) {
    const auto format = static_cast<VkFormat>(info.format);
    VkImageCreateInfo image{};
    image.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    image.imageType = VK_IMAGE_TYPE_2D;
    image.format = format;
    image.extent = {info.width, info.height, 1};
    image.mipLevels = info.mipCount;
    image.arrayLayers = info.arraySize * info.faceCount;
    image.samples = static_cast<VkSampleCountFlagBits>(info.sampleCount);
    image.tiling = VK_IMAGE_TILING_OPTIMAL;
    // The layout contract needs the attachment, composition and captures read, and clients may always be
    // copied from.
    image.usage = vulkan_usage(info.usageFlags) | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                  VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                  (is_depth_format(format) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                           : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    if (info.usageFlags & XR_SWAPCHAIN_USAGE_MUTABLE_FORMAT_BIT)
        image.flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
    if (info.faceCount == 6) image.flags |= VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
    return image;
}

}  // namespace

std::span<const std::int64_t> swapchain_formats() {
    static constexpr std::int64_t formats[] = {VK_FORMAT_R8G8B8A8_SRGB,  VK_FORMAT_B8G8R8A8_SRGB,
                                               VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM,
                                               VK_FORMAT_D32_SFLOAT,     VK_FORMAT_D16_UNORM};
    return formats;
}

bool is_depth_format(VkFormat format) {
    return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM;
}

Swapchain::Swapchain(std::shared_ptr<Session> session, const XrSwapchainCreateInfo& info)
    : session_(std::move(session)), info_(info) {
    info_.next = nullptr;
    const VkImageCreateInfo image = image_info(info);
    const VulkanDevice& device = session_->device();
    verify(device.supports(image), XR_ERROR_FEATURE_UNSUPPORTED);
    const std::uint32_t count = info.createFlags & XR_SWAPCHAIN_CREATE_STATIC_IMAGE_BIT ? 1 : 3;
    for (std::uint32_t i = 0; i < count; ++i) {
        images_.push_back(device.create_image(image, "simulator swapchain image " + std::to_string(i)));
    }
}

std::vector<VkImage> Swapchain::images() const {
    std::vector<VkImage> handles;
    for (const auto& image : images_) handles.push_back(*image.image);
    return handles;
}

VkImageLayout Swapchain::layout() const {
    return is_depth_format(format()) ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                                     : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}

VkImageAspectFlags Swapchain::aspect() const {
    return is_depth_format(format()) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

void Swapchain::bring_to_layout() {
    VulkanDevice& device = session_->device();
    device.submit([&](VkCommandBuffer commands) {
        std::vector<VkImageMemoryBarrier> barriers;
        for (const auto& image : images_) {
            VkImageMemoryBarrier& barrier = barriers.emplace_back();
            barrier = {};
            barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
            barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
            barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
            barrier.newLayout = layout();
            barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
            barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
            barrier.image = *image.image;
            barrier.subresourceRange = {aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
        }
        device.functions().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                                VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr,
                                                static_cast<std::uint32_t>(barriers.size()), barriers.data());
    });
}

std::uint32_t Swapchain::acquire() {
    const std::lock_guard lock(mutex_);
    const bool is_static = info_.createFlags & XR_SWAPCHAIN_CREATE_STATIC_IMAGE_BIT;
    verify(acquired_.size() < images_.size() && !(is_static && acquired_count_ > 0),
           XR_ERROR_CALL_ORDER_INVALID);
    // The first call in which the client's queue may be used.
    if (acquired_count_ == 0) bring_to_layout();
    acquired_.push_back(static_cast<std::uint32_t>(acquired_count_++ % images_.size()));
    return acquired_.back();
}

XrResult Swapchain::wait(XrDuration timeout) {
    std::unique_lock lock(mutex_);
    verify(!acquired_.empty() && !waited_, XR_ERROR_CALL_ORDER_INVALID);
    Instance& instance = session_->instance();
    if (timeout != XR_INFINITE_DURATION && instance.take_swapchain_timeout()) {
        lock.unlock();
        if (instance.clock().mode() == TimeMode::Real)
            std::this_thread::sleep_for(std::chrono::nanoseconds(timeout));
        return XR_TIMEOUT_EXPIRED;
    }
    session_->release_images(*this);
    waited_ = true;
    return XR_SUCCESS;
}

void Swapchain::release() {
    const std::lock_guard lock(mutex_);
    verify(waited_, XR_ERROR_CALL_ORDER_INVALID);
    waited_ = false;
    shown_ = acquired_.front();
    acquired_.pop_front();
}

std::optional<std::uint32_t> Swapchain::shown() const {
    const std::lock_guard lock(mutex_);
    return shown_;
}

VkImageView Swapchain::view(std::uint32_t index, std::uint32_t array_index) {
    const std::lock_guard lock(mutex_);
    VulkanOwned<VkImageView>& view = views_[{index, array_index}];
    if (!*view) {
        view = session_->device().create_view(image(index), format(), aspect(), array_index,
                                              "simulator swapchain view");
    }
    return *view;
}

}  // namespace foveray::simulator
