#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include <openxr/openxr.h>

#include "base/view.h"
#include "xr/simulator/swapchain.h"

namespace foveray::simulator {

class Session;
class Space;

/// The part of a swapchain that a layer shows.
struct SubImage {
    std::shared_ptr<Swapchain> swapchain;
    std::uint32_t image = 0;  // of the swapchain's
    XrRect2Di rect{};
    std::uint32_t array_index = 0;
};

struct ProjectionView {
    Pose space_from_view;
    Fov fov;
    SubImage image;
};

struct Projection {
    std::vector<ProjectionView> views;  // in the order of the view configuration
};

/// A picture on a surface in space.
struct Surface {
    enum class Kind { Quad, Cylinder, Equirect };
    Kind kind = Kind::Quad;
    SubImage image;
    Pose space_from_surface;
    XrEyeVisibility eyes = XR_EYE_VISIBILITY_BOTH;
    float radius = 0.0f;  // 0: infinite
    vec4 shape{0.0f};     // as in shaders/shared/composition.h, CompositionSource
};

/// XR_KHR_composition_layer_color_scale_bias.
struct ColorScaleBias {
    vec4 scale{1.0f}, bias{0.0f};
};

struct Layer {
    XrCompositionLayerFlags flags = 0;
    std::shared_ptr<Space> space;
    std::optional<ColorScaleBias> color;
    std::variant<Projection, Surface> content;
};

/// Verifies all layers of a frame and gives them, the rearmost first.
std::vector<Layer> read_layers(const Session& session, const XrFrameEndInfo& info);

/// nullptr when there is none.
const Projection* rearmost_projection(const std::vector<Layer>& layers);

}  // namespace foveray::simulator
