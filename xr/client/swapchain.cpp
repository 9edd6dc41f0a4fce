#include "xr/client/swapchain.h"

#include <algorithm>
#include <cassert>

#include "base/error.h"

namespace foveray::xr {
namespace {

constexpr std::int64_t format_of(Swapchain::Kind kind) {
    return kind == Swapchain::Kind::Color ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_D32_SFLOAT;
}

// Together the half second of `acquire`.
constexpr XrDuration image_wait = 100'000'000;
constexpr int image_waits = 5;

}  // namespace

bool Swapchain::offers(XrSession session, Kind kind) {
    std::uint32_t count = 0;
    check(xrEnumerateSwapchainFormats(session, 0, &count, nullptr), "xrEnumerateSwapchainFormats");
    std::vector<std::int64_t> formats(count);
    check(xrEnumerateSwapchainFormats(session, count, &count, formats.data()), "xrEnumerateSwapchainFormats");
    return std::find(formats.begin(), formats.end(), format_of(kind)) != formats.end();
}

Swapchain::Swapchain(XrSession session, Kind kind, uvec2 size, const char* name) : kind_(kind) {
    if (!offers(session, kind)) {
        throw_missing("OpenXR runtime",
                      std::string("it offers no ") + (kind == Kind::Color ? "R8G8B8A8_SRGB" : "D32_SFLOAT") +
                          " swapchain for " + name,
                      "use a runtime that does, or --runtime simulator");
    }
    XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
    info.usageFlags = XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT |
                      (kind == Kind::Color ? XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT
                                           : XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    info.format = format_of(kind);
    info.sampleCount = 1;
    info.width = size.x;
    info.height = size.y;
    info.faceCount = info.arraySize = info.mipCount = 1;
    check(xrCreateSwapchain(session, &info, handle_.put()), "xrCreateSwapchain");

    std::uint32_t count = 0;
    check(xrEnumerateSwapchainImages(get(), 0, &count, nullptr), "xrEnumerateSwapchainImages");
    std::vector<XrSwapchainImageVulkan2KHR> images(count, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR});
    check(xrEnumerateSwapchainImages(get(), count, &count,
                                     reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
          "xrEnumerateSwapchainImages");
    for (const auto& image : images) images_.push_back(image.image);
}

bool Swapchain::acquire(const gpu::Device& device) {
    if (image_ == Image::Released) {
        const auto lock = device.lock_queue();
        check(xrAcquireSwapchainImage(get(), nullptr, &index_), "xrAcquireSwapchainImage");
        image_ = Image::Acquired;
    }
    const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, image_wait};
    for (int tries = 0; image_ == Image::Acquired && tries < image_waits; ++tries) {
        if (check(xrWaitSwapchainImage(get(), &wait), "xrWaitSwapchainImage") != XR_TIMEOUT_EXPIRED)
            image_ = Image::Writable;
    }
    return image_ == Image::Writable;
}

void Swapchain::record_copy(const gpu::Commands& cmd, vk::Buffer source, vk::DeviceSize offset, uvec2 size) {
    assert(image_ == Image::Writable);
    using gpu::Access;
    using Layout = vk::ImageLayout;
    const bool color = kind_ == Kind::Color;
    const auto aspect = color ? vk::ImageAspectFlagBits::eColor : vk::ImageAspectFlagBits::eDepth;
    const Access attachment = color ? Access::ColorAttachment : Access::DepthAttachment;
    const vk::Image image(images_[index_]);
    gpu::transition(cmd.vk(), image, attachment, Layout::eUndefined, Access::TransferWrite,
                    Layout::eTransferDstOptimal, aspect);
    cmd->copyBufferToImage(source, image, Layout::eTransferDstOptimal,
                           vk::BufferImageCopy(offset, 0, 0, {aspect, 0, 0, 1}, {}, {size.x, size.y, 1}));
    gpu::transition(cmd.vk(), image, Access::TransferWrite, Layout::eTransferDstOptimal, attachment,
                    color ? Layout::eColorAttachmentOptimal : Layout::eDepthStencilAttachmentOptimal, aspect);
}

void Swapchain::release(const gpu::Device& device) {
    if (image_ != Image::Writable) return;
    const auto lock = device.lock_queue();
    check(xrReleaseSwapchainImage(get(), nullptr), "xrReleaseSwapchainImage");
    image_ = Image::Released;
}

}  // namespace foveray::xr
