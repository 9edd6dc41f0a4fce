#pragma once

#include "render/scene/scene_builder.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {

/// Adds what an entry of a scene file's "objects" describes (docs/scene-format.md): shape, material, node and
/// animation. Throws Fault(BadInput) with file, place and what is possible instead.
void add_object(SceneBuilder& builder, const SceneValues& values, const Json& object,
                const std::string& place);

}  // namespace foveray::scene
