#pragma once

#include <string>

#include "base/json.h"
#include "render/scene/scene_builder.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {

/// The shape of an object of a scene file whose "shape" is "voxels". Objects with the same file and size
/// share their voxels. Throws Fault(BadInput).
Shape read_voxel_object(SceneBuilder& builder, const SceneValues& values, const Json& object,
                        const std::string& place);

}  // namespace foveray::scene
