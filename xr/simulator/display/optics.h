#pragma once

#include <optional>
#include <vector>

#include <openxr/openxr.h>

#include "base/headset_profile.h"
#include "base/view.h"

namespace foveray::simulator {

/// Views of a configuration in the order of OpenXR's view index; empty when the headset does not have it.
std::vector<HeadsetProfile::ViewProfile> views_of(const HeadsetProfile& profile,
                                                  XrViewConfigurationType type);

/// Gaze-contingent size of a view, in pixels: focus views shrink, context views stay.
uvec2 foveated_size(const HeadsetProfile& profile, const HeadsetProfile::ViewProfile& view);
/// Gaze-contingent field of view: the focus, shrunk, round `direction` in the eye's frame and moved inside
/// the context where it would leave it.
Fov foveated_fov(const HeadsetProfile& profile, const HeadsetProfile::ViewProfile& view, vec3 direction);

/// The picture that an eye is shown: over the context's field of view, in the focus's density where there is
/// one, at most 2048 pixels a side, and even. As large in every frame.
struct EyeDisplay {
    Eye eye = Eye::Left;
    Fov fov;
    uvec2 size{0};
    Pose head_from_eye;
};
EyeDisplay eye_display(const HeadsetProfile& profile, XrViewConfigurationType type, Eye eye, float max_size);

Pose head_from_eye(const HeadsetProfile& profile, Eye eye);

/// XR_KHR_visibility_mask. Vertices on the z = -1 plane of the eye's frame. Empty when all of the view is
/// seen.
struct VisibilityMask {
    std::vector<vec2> vertices;
    std::vector<std::uint32_t> indices;
};
VisibilityMask visibility_mask(const HeadsetProfile& profile, const HeadsetProfile::ViewProfile& view,
                               XrVisibilityMaskTypeKHR type);

}  // namespace foveray::simulator
