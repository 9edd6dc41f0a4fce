#pragma once

#include <map>

#include "render/scene/gltf_document.h"
#include "render/scene/scene_builder.h"

namespace foveray::scene {

/// Adds the document's animations for nodes that `nodes` maps (glTF index to id). All of them play at once,
/// so an animation that moves what an earlier one moves already is left out with a warning. Throws
/// Fault(BadInput).
void add_animations(SceneBuilder& builder, const GltfDocument& document, const std::map<int, NodeId>& nodes);

}  // namespace foveray::scene
