#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/frame.h"
#include "base/view.h"

namespace foveray {

/// HERR eq. 1, ppd(e) = a / (e + b) with e in degrees, never above the display's own density `cap`.
struct Acuity {
    float a = 200.0f;
    float b = 1.0f;
    float cap_ppd = 60.0f;
    float outer_degrees = 60.0f;  // eccentricity at which the pattern ends, fixed per headset
};

/// A headset as its maker describes it: assets/headsets/NAME.json, checked by headset.schema.json beside it.
struct HeadsetProfile {
    struct ViewProfile {
        Eye eye = Eye::Left;
        ViewRole role = ViewRole::Context;
        uvec2 size{0};  // pixels, width × height
        Fov fov;
        float ppd = 0.0f;  // pixels a degree at the view's centre
    };
    std::string name, display_name, source;  // source: where the figures are from
    double rate_hz = 90.0;
    float ipd = 0.063f;  // metres
    bool eye_tracking = false;
    std::vector<ViewProfile> views;  // as in Frame::views
    std::vector<BlendMode> blend_modes;
    std::string interaction_profile;  // an OpenXR path
    Acuity acuity;
    float foveated_focus_scale =
        1.0f;  // gaze-contingent focus views: this part of the fixed one's width and height
    std::vector<vec2>
        hidden_outline;  // convex visible outline of the left eye's context, tangents; empty: all seen
};

/// `name_or_file`: a name in assets/headsets or a path to a .json file. Throws Fault(BadInput) listing the
/// names that exist.
HeadsetProfile read_headset_profile(const std::string& name_or_file);

/// Writes what read_headset_profile reads; the name is the file's. Throws Fault(BadInput) when it cannot.
void write_headset_profile(const std::filesystem::path& file, const HeadsetProfile& profile);

/// Folder that holds assets at run time: $FOVERAY_ASSETS, beside the program or library that this code is part of,
/// or the source tree.
std::filesystem::path assets_folder();

}  // namespace foveray
