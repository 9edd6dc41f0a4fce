#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "render/scene/scene_builder.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {

/// The shape of an object of a scene file whose "shape" is "user", still without the parameters' values.
/// Objects that name the same file share it. Throws Fault(BadInput) where the file's arguments and the
/// object's parameters do not fit.
Shape read_user_object(SceneBuilder& builder, const SceneValues& values, const Json& object,
                       const std::string& place);

/// The parameters in the order of the shape's values. The names are good until the scene has another user's
/// shape.
std::vector<ShapeParameter> user_parameters(const Scene& scene, const Shape& shape);

}  // namespace foveray::scene
