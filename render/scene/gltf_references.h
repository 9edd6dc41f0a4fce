#pragma once

#include "render/scene/gltf_document.h"

namespace foveray::scene {

/// Every property of the document that is an index into one of its arrays is an unsigned integer below that
/// array's length; the node tree has no cycles and no node with two parents. Throws Fault(BadInput) with the
/// place.
void check_references(const GltfDocument& document);

}  // namespace foveray::scene
