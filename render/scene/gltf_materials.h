#pragma once

#include <vector>

#include "render/scene/gltf_document.h"
#include "render/scene/scene_builder.h"

namespace foveray::scene {

/// Adds the document's materials and what of its textures and images they use; element i is the id of
/// /materials/i. Throws Fault(BadInput).
std::vector<MaterialId> add_materials(SceneBuilder& builder, const GltfDocument& document);

}  // namespace foveray::scene
