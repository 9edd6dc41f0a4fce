#pragma once

#include <vector>

#include "render/scene/animator.h"
#include "shaders/shared/scene.h"

namespace foveray::render {

/// A frame's lights as shaders read them: area lights, whose shadows cost most, then punctual
/// lights, each in the scene's order.
std::vector<shared::Light> pack_lights(const scene::SceneChanges& changes);

}  // namespace foveray::render
