#pragma once

#include <string>

#include "render/scene/scene_builder.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {

/// The "mesh" of an object of a scene file, a list of made meshes, as one mesh: a primitive for each run of
/// parts with equal materials. docs/scene-format.md describes them. Throws Fault(BadInput) with file and
/// place.
Mesh read_mesh_parts(SceneBuilder& builder, const SceneValues& values, const Json& parts,
                     const std::string& name, const std::string& place);

}  // namespace foveray::scene
