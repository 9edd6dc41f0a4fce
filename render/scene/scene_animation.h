#pragma once

#include <span>
#include <string>

#include "render/scene/scene_builder.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {

/// Adds the "animation" of `object`, if it has one: channels that move `node` or its shape's parameters.
/// Throws Fault(BadInput) with file and place.
void add_animation(SceneBuilder& builder, const SceneValues& values, const Json& object,
                   const std::string& place, NodeId node, std::span<const ShapeParameter> parameters);

}  // namespace foveray::scene
