#pragma once

#include "render/scene/scene_builder.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {

/// Reads "probes" of a scene file. Without a place of its own the grid is fitted to what `builder` holds so
/// far.
void add_probes(SceneBuilder& builder, const SceneValues& values, const Json& json);

}  // namespace foveray::scene
