#pragma once

#include "base/headset_profile.h"
#include "shaders/shared/polar.h"

namespace foveray::render {

/// The polar image of a headset: HERR section 3.2 with the display's density as a cap (docs/architecture.md,
/// "Foveation"). Eccentricities in degrees. `resolution_scale` scales both axes; `angular_ratio` is the
/// number of angular samples for one radial sample at the same scale.
shared::PolarMap make_polar_map(const Acuity& acuity, float resolution_scale, float angular_ratio);

/// The same image with a flat fovea of at least that radius: as many samples between gaze and outer edge, so
/// the density inside falls and the density outside rises. For frames without gaze. A fovea smaller than
/// where the cap holds changes nothing.
shared::PolarMap widen_fovea(const shared::PolarMap& map, float fovea_degrees);

/// Angular samples that would make the density along the circle nowhere smaller than along the radius: the
/// maximum of 360 sin(e) ppd(e), about 1,173 for 200 / (e + 1).
float equal_density_angular_samples(const shared::PolarMap& map);

}  // namespace foveray::render
