#pragma once

#include <memory>
#include <vector>

#include <openxr/openxr.h>

#include "base/view.h"
#include "xr/simulator/swapchain.h"

namespace foveray::simulator {

class Session;

/// The part of a swapchain that a layer shows.
struct SubImage {
    std::shared_ptr<Swapchain> swapchain;
    XrRect2Di rect{};
    std::uint32_t array_index = 0;
};

struct ProjectionView {
    Fov fov;
    SubImage image;
};

struct ProjectionLayer {
    XrCompositionLayerFlags flags = 0;
    std::vector<ProjectionView> views;  // in the order of the view configuration
};

/// Verifies all layers of a frame and gives its projection layers, the rearmost first. Quad, cylinder and
/// equirectangular layers are verified and not shown.
std::vector<ProjectionLayer> read_layers(const Session& session, const XrFrameEndInfo& info);

}  // namespace foveray::simulator
