#pragma once

#include <optional>
#include <vector>

#include "render/scene/gltf_document.h"
#include "render/scene/scene_builder.h"

namespace foveray::scene {

/// Adds the document's meshes; element i is the id of /meshes/i, or nothing if it has no triangles. Throws
/// Fault(BadInput).
std::vector<std::optional<MeshId>> add_meshes(SceneBuilder& builder, const GltfDocument& document,
                                              const std::vector<MaterialId>& materials);

}  // namespace foveray::scene
