#pragma once

#include "render/scene/scene.h"

namespace foveray::scene {

/// Whether the transform keeps all three dimensions: rays cannot be taken into a space that has fewer.
bool is_invertible(const mat4& transform);

/// The first node, from the root on, at which this node's transform to the world loses a dimension; none if
/// it keeps them, or if the scale of one of these nodes is animated, so that it may have them at another
/// time.
std::optional<NodeId> flattened_by(const Scene& scene, NodeId node);

}  // namespace foveray::scene
