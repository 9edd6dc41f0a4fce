
#include <bit>

#include "xr/simulator/api/functions.h"
#include "xr/simulator/api/limits.h"
#include "xr/simulator/api/openxr_vulkan.h"
#include "xr/simulator/session.h"
#include "xr/simulator/swapchain.h"

namespace foveray::simulator {
namespace {

constexpr XrSwapchainUsageFlags known_usages =
    XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
    XR_SWAPCHAIN_USAGE_UNORDERED_ACCESS_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT |
    XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT |
    XR_SWAPCHAIN_USAGE_MUTABLE_FORMAT_BIT;

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL xrEnumerateSwapchainFormats(XrSession session, std::uint32_t capacity,
                                                           std::uint32_t* count, std::int64_t* formats) {
    return guarded([&] {
        const bool headless = get<Session>(session)->headless();
        enumerate_values(headless ? std::span<const std::int64_t>() : swapchain_formats(), capacity, count,
                         formats);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrCreateSwapchain(XrSession session, const XrSwapchainCreateInfo* info,
                                                 XrSwapchain* swapchain) {
    return guarded([&] {
        const auto object = get<Session>(session);
        verify_structure(info, XR_TYPE_SWAPCHAIN_CREATE_INFO);
        verify(swapchain != nullptr);
        constexpr auto known_flags =
            XR_SWAPCHAIN_CREATE_PROTECTED_CONTENT_BIT | XR_SWAPCHAIN_CREATE_STATIC_IMAGE_BIT;
        verify((info->createFlags & ~known_flags) == 0 && (info->usageFlags & ~known_usages) == 0);
        verify((info->createFlags & XR_SWAPCHAIN_CREATE_PROTECTED_CONTENT_BIT) == 0,
               XR_ERROR_FEATURE_UNSUPPORTED);
        verify(!object->headless() &&
                   std::ranges::find(swapchain_formats(), info->format) != swapchain_formats().end(),
               XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
        verify(info->width > 0 && info->height > 0 && info->sampleCount > 0 && info->arraySize > 0 &&
               info->mipCount > 0 && (info->faceCount == 1 || info->faceCount == 6));
        verify(info->faceCount == 1 || info->width == info->height);
        verify(info->mipCount <=
               static_cast<std::uint32_t>(std::bit_width(std::max(info->width, info->height))));
        verify(info->width <= max_swapchain_size && info->height <= max_swapchain_size &&
                   info->sampleCount == 1 && info->arraySize <= max_array_size,
               XR_ERROR_FEATURE_UNSUPPORTED);
        *swapchain = add_object(std::make_shared<Swapchain>(object, *info), object->id());
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrDestroySwapchain(XrSwapchain swapchain) {
    return guarded([&] { destroy<Swapchain>(swapchain); });
}

XRAPI_ATTR XrResult XRAPI_CALL xrEnumerateSwapchainImages(XrSwapchain swapchain, std::uint32_t capacity,
                                                          std::uint32_t* count,
                                                          XrSwapchainImageBaseHeader* images) {
    return guarded([&] {
        const auto handles = get<Swapchain>(swapchain)->images();
        auto* targets = reinterpret_cast<XrSwapchainImageVulkanKHR*>(images);
        enumerate(static_cast<std::uint32_t>(handles.size()), capacity, count, targets,
                  [&](XrSwapchainImageVulkanKHR& target, std::uint32_t i) {
                      verify_structure(&target, XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR);
                      target.image = handles[i];
                  });
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrAcquireSwapchainImage(XrSwapchain swapchain,
                                                       const XrSwapchainImageAcquireInfo* info,
                                                       std::uint32_t* index) {
    return guarded([&] {
        const auto object = get<Swapchain>(swapchain);
        verify_optional_structure(info, XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO);
        verify(index != nullptr);
        *index = object->acquire();
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrWaitSwapchainImage(XrSwapchain swapchain,
                                                    const XrSwapchainImageWaitInfo* info) {
    return guarded([&] {
        const auto object = get<Swapchain>(swapchain);
        verify_structure(info, XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
        return object->wait(info->timeout);
    });
}

XRAPI_ATTR XrResult XRAPI_CALL xrReleaseSwapchainImage(XrSwapchain swapchain,
                                                       const XrSwapchainImageReleaseInfo* info) {
    return guarded([&] {
        const auto object = get<Swapchain>(swapchain);
        verify_optional_structure(info, XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO);
        object->release();
    });
}

}  // namespace foveray::simulator
