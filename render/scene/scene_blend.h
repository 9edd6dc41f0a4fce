#pragma once

#include "render/scene/blend.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {

/// The "parts" of a blend object of a scene file; docs/scene-format.md describes them. Throws Fault(BadInput)
/// with file and place.
std::vector<BlendPart> read_blend_parts(const SceneValues& values, const Json& parts,
                                        const std::string& place);

}  // namespace foveray::scene
