#pragma once

#include "render/scene/scene.h"

namespace foveray::render {

/// Hundreds of textured boxes and spheres of all sizes before a textured wall, in every direction that a
/// headset at the origin shows along -z: edges and detail at all scales, as pictures of the world have them
/// ("dead leaves"). Lit by a sun and the environment; the same for the same seed.
scene::Scene clutter_scene(std::uint32_t seed);

}  // namespace foveray::render
