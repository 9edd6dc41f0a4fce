#pragma once

#include <cstdint>
#include <vector>

#include "shaders/shared/composition.h"
#include "xr/simulator/display/layers.h"
#include "xr/simulator/display/optics.h"

namespace foveray::simulator {

/// A frame as the client ended it, and where the wearer's head is while it is shown.
struct SubmittedFrame {
    std::vector<Layer> layers;  // the rearmost first
    XrEnvironmentBlendMode blend_mode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
    std::uint64_t index = 0;
    XrTime display_time = 0;
    Pose stage_from_head;
};

/// A layer as one eye sees it.
struct LayerDraw {
    shared::CompositionDraw draw;
    const SubImage* source = nullptr;
    const SubImage* focus = nullptr;  // with COMPOSITION_FOCUSED_PROJECTION
};

/// What an eye sees of the layers, the rearmost first. Spaces are located at the display time. Projections
/// are turned from the orientation that they were rendered for to the eye's at that time, and stay as they
/// are where the head cannot be located; other layers are then not seen.
std::vector<LayerDraw> draw_layers(const SubmittedFrame& frame, const EyeDisplay& eye);

/// What is behind the layers; the kind and colour of the background are the caller's.
shared::CompositionDraw draw_background(const SubmittedFrame& frame, const EyeDisplay& eye);

}  // namespace foveray::simulator
