#pragma once

#include <map>
#include <vector>

#include "xr/client/openxr.h"

/// What our client hands to the OpenXR loader. Linked into a test program it stands in front of the loader's
/// own functions, keeps what they were given, and passes it on.
namespace foveray::xr::loader_spy {

/// One call of xrEndFrame, deep enough to look at.
struct EndedFrame {
    XrTime display_time = 0;
    XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_MAX_ENUM;
    XrResult result = XR_SUCCESS;
    struct Layer {
        XrCompositionLayerFlags flags = 0;
        std::vector<XrCompositionLayerProjectionView> views;  // without their chains
        std::vector<XrCompositionLayerDepthInfoKHR> depths;   // one a view, or none
    };
    std::vector<Layer> layers;
};

/// Since the last call.
std::vector<EndedFrame> take_ended_frames();
/// The image that the client last acquired from a swapchain.
std::uint32_t last_image(XrSwapchain swapchain);

/// From now on the runtime hears nothing of requests to exit.
void swallow_exit_requests(bool swallow);

}  // namespace foveray::xr::loader_spy
