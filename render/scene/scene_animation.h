#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/scene/scene_builder.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {

/// Adds the "animation" of `object`, if it has one: channels that move `node` or its shape's parameters.
/// Throws Fault(BadInput) with file and place.
void add_animation(SceneBuilder& builder, const SceneValues& values, const Json& object,
                   const std::string& place, NodeId node, std::span<const ShapeParameter> parameters);

/// The "animation" of a material's JSON, which is that material.
void add_material_animation(SceneBuilder& builder, const SceneValues& values, const Json& json,
                            const std::string& place, MaterialId material);

/// "present" of an object, model or light: seconds of session time. Empty where it says nothing.
std::vector<Presence> read_presence(const SceneValues& values, const Json& object, const std::string& place);

}  // namespace foveray::scene
