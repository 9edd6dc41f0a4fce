#pragma once

#include "render/scene/scene_builder.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {

/// The "material" of a scene file's object or part of one, which the schema has accepted; a rough, two-sided
/// dielectric where nothing is said.
Material read_material(const SceneValues& values, const Json& json, const std::string& name,
                       const std::string& place);
/// Adds what read_material() gave, with its animation.
MaterialId add_material(SceneBuilder& builder, const SceneValues& values, const Json& json, Material material,
                        const std::string& place);

}  // namespace foveray::scene
