#include "app/mirror/window_swapchain.h"

#include <algorithm>

#include "base/error.h"

namespace foveray::app {
namespace {

[[noreturn]] void throw_no_pictures(const gpu::Device& device, const std::string& what) {
    throw_missing("--mirror", device.name() + " " + what, "run it without --mirror");
}

}  // namespace

WindowSwapchain::WindowSwapchain(const gpu::Device& device, const DesktopWindow& window)
    : device_(device),
      window_(window),
      surface_(window.make_surface(device.instance())),
      acquired_(device.vk(), vk::SemaphoreCreateInfo()) {
    if (!device.physical().getSurfaceSupportKHR(device.queue_family(), *surface_)) {
        throw_no_pictures(device, "cannot show pictures in the desktop's windows");
    }
    device.set_name(*acquired_, "mirror image acquired");
    choose_format();
    make_render_pass();
    make_swapchain();
}

void WindowSwapchain::choose_format() {
    // Not an sRGB format: the pictures are encoded already.
    const auto formats = device_.physical().getSurfaceFormatsKHR(*surface_);
    for (const auto& candidate : formats) {
        if (candidate.format != vk::Format::eB8G8R8A8Unorm && candidate.format != vk::Format::eR8G8B8A8Unorm)
            continue;
        format_ = candidate;
        return;
    }
    throw_no_pictures(device_, "offers no 8-bit format for windows");
}

void WindowSwapchain::make_render_pass() {
    const vk::AttachmentDescription color(
        {}, format_.format, vk::SampleCountFlagBits::e1, vk::AttachmentLoadOp::eLoad,
        vk::AttachmentStoreOp::eStore, vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare,
        vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::ePresentSrcKHR);
    const vk::AttachmentReference reference(0, vk::ImageLayout::eColorAttachmentOptimal);
    const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, reference);
    render_pass_ = {device_.vk(), vk::RenderPassCreateInfo({}, color, subpass)};
    device_.set_name(*render_pass_, "mirror");
}

void WindowSwapchain::make_swapchain() {
    {
        const auto lock = device_.lock_queue();
        device_.vk().waitIdle();
    }
    images_.clear();
    const auto capabilities = device_.physical().getSurfaceCapabilitiesKHR(*surface_);
    if (!(capabilities.supportedUsageFlags & vk::ImageUsageFlagBits::eTransferDst)) {
        throw_no_pictures(device_, "cannot copy pictures into windows");
    }
    extent_ = capabilities.currentExtent;
    if (extent_.width == UINT32_MAX) {
        const uvec2 size = window_.size();
        extent_ = vk::Extent2D(size.x, size.y);
    }
    is_stale_ = true;
    if (extent_.width == 0 || extent_.height == 0) return;

    // The headset sets the pace; the mirror must not wait for the desktop's display where that can be helped.
    vk::PresentModeKHR mode = vk::PresentModeKHR::eFifo;
    const auto modes = device_.physical().getSurfacePresentModesKHR(*surface_);
    for (const auto wanted : {vk::PresentModeKHR::eImmediate, vk::PresentModeKHR::eMailbox}) {
        if (std::find(modes.begin(), modes.end(), wanted) != modes.end()) mode = wanted;
    }
    std::uint32_t count = std::max(capabilities.minImageCount + 1, 2u);
    if (capabilities.maxImageCount > 0) count = std::min(count, capabilities.maxImageCount);
    const vk::SwapchainCreateInfoKHR info(
        {}, *surface_, count, format_.format, format_.colorSpace, extent_, 1,
        vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eColorAttachment,
        vk::SharingMode::eExclusive, {}, capabilities.currentTransform,
        vk::CompositeAlphaFlagBitsKHR::eOpaque, mode, VK_TRUE, *swapchain_);
    swapchain_ = vk::raii::SwapchainKHR(device_.vk(), info);
    for (const VkImage image : swapchain_.getImages()) {
        ImageParts& parts = images_.emplace_back();
        parts.image = image;
        parts.view = {device_.vk(),
                      vk::ImageViewCreateInfo({}, image, vk::ImageViewType::e2D, format_.format, {},
                                              {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1})};
        const vk::ImageView view = *parts.view;
        parts.framebuffer = {device_.vk(), vk::FramebufferCreateInfo({}, *render_pass_, view, extent_.width,
                                                                     extent_.height, 1)};
        parts.finished = {device_.vk(), vk::SemaphoreCreateInfo()};
        device_.set_name(parts.image, "mirror image");
        device_.set_name(*parts.view, "mirror image");
        device_.set_name(*parts.framebuffer, "mirror");
        device_.set_name(*parts.finished, "mirror finished");
    }
    is_stale_ = false;
}

std::optional<WindowSwapchain::Target> WindowSwapchain::acquire() {
    const uvec2 size = window_.size();
    if (size.x == 0 || size.y == 0) return std::nullopt;
    if (is_stale_ || size != uvec2(extent_.width, extent_.height)) make_swapchain();
    if (is_stale_) return std::nullopt;
    try {
        const auto [result, index] = swapchain_.acquireNextImage(UINT64_MAX, *acquired_);
        is_stale_ = result == vk::Result::eSuboptimalKHR;
        current_ = index;
    } catch (const vk::OutOfDateKHRError&) {
        is_stale_ = true;
        return std::nullopt;
    }
    const ImageParts& parts = images_[current_];
    return Target{parts.image, *parts.framebuffer, *acquired_, *parts.finished, extent_};
}

void WindowSwapchain::present() {
    const vk::Semaphore finished = *images_[current_].finished;
    const vk::SwapchainKHR swapchain = *swapchain_;
    try {
        const auto lock = device_.lock_queue();
        const vk::Result result =
            device_.queue().presentKHR(vk::PresentInfoKHR(finished, swapchain, current_));
        is_stale_ |= result == vk::Result::eSuboptimalKHR;
    } catch (const vk::OutOfDateKHRError&) {
        is_stale_ = true;
    }
}

}  // namespace foveray::app
