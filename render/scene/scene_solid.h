#pragma once

#include "render/scene/csg.h"
#include "render/scene/scene_builder.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {

/// The "solid" of a csg object of a scene file; docs/scene-format.md describes it. Adds its leaves'
/// materials. Throws Fault(BadInput) with file and place.
CsgSolid read_solid(SceneBuilder& builder, const SceneValues& values, const Json& json,
                    const std::string& place);

}  // namespace foveray::scene
