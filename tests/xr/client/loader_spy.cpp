#include "tests/xr/client/loader_spy.h"

#include <dlfcn.h>
#include <utility>

namespace foveray::xr::loader_spy {
namespace {

std::vector<EndedFrame> ended_frames;
std::map<XrSwapchain, std::uint32_t> images;
bool swallows_exit_requests = false;

template <typename Function>
Function loaders(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

EndedFrame::Layer read_layer(const XrCompositionLayerProjection& projection) {
    EndedFrame::Layer layer;
    layer.flags = projection.layerFlags;
    for (std::uint32_t i = 0; i < projection.viewCount; ++i) {
        layer.views.push_back(projection.views[i]);
        layer.views.back().next = nullptr;
        const auto* depth = static_cast<const XrCompositionLayerDepthInfoKHR*>(projection.views[i].next);
        if (depth && depth->type == XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR) layer.depths.push_back(*depth);
    }
    return layer;
}

}  // namespace

std::vector<EndedFrame> take_ended_frames() { return std::exchange(ended_frames, {}); }

std::uint32_t last_image(XrSwapchain swapchain) { return images.at(swapchain); }

void swallow_exit_requests(bool swallow) { swallows_exit_requests = swallow; }

}  // namespace foveray::xr::loader_spy

using namespace foveray::xr;

extern "C" XRAPI_ATTR XrResult XRAPI_CALL xrEndFrame(XrSession session, const XrFrameEndInfo* info) {
    loader_spy::EndedFrame ended;
    ended.display_time = info->displayTime;
    ended.blend = info->environmentBlendMode;
    for (std::uint32_t i = 0; i < info->layerCount; ++i) {
        ended.layers.push_back(
            loader_spy::read_layer(*reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[i])));
    }
    ended.result = loader_spy::loaders<PFN_xrEndFrame>("xrEndFrame")(session, info);
    loader_spy::ended_frames.push_back(std::move(ended));
    return loader_spy::ended_frames.back().result;
}

extern "C" XRAPI_ATTR XrResult XRAPI_CALL xrAcquireSwapchainImage(XrSwapchain swapchain,
                                                                  const XrSwapchainImageAcquireInfo* info,
                                                                  std::uint32_t* index) {
    const XrResult result =
        loader_spy::loaders<PFN_xrAcquireSwapchainImage>("xrAcquireSwapchainImage")(swapchain, info, index);
    if (XR_SUCCEEDED(result)) loader_spy::images[swapchain] = *index;
    return result;
}

extern "C" XRAPI_ATTR XrResult XRAPI_CALL xrRequestExitSession(XrSession session) {
    if (loader_spy::swallows_exit_requests) return XR_SUCCESS;
    return loader_spy::loaders<PFN_xrRequestExitSession>("xrRequestExitSession")(session);
}
