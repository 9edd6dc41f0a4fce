#include "render/scene/singular.h"

#include <algorithm>
#include <cmath>

namespace foveray::scene {
namespace {

bool has_animated_scale(const Scene& scene, NodeId node) {
    return std::ranges::any_of(scene.animations, [&](const Animation& animation) {
        return std::ranges::any_of(animation.channels, [&](const AnimationChannel& channel) {
            return channel.node == node && channel.property == AnimatedProperty::Scale;
        });
    });
}

}  // namespace

bool is_invertible(const mat4& transform) {
    const mat3 linear(transform);
    const float size = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    return std::abs(glm::determinant(linear)) > 1e-6f * size;
}

std::optional<NodeId> flattened_by(const Scene& scene, NodeId node) {
    std::vector<NodeId> chain;  // from the node up
    for (std::optional<NodeId> at = node; at; at = scene.nodes[*at].parent) chain.push_back(*at);
    mat4 world(1.0f);
    std::optional<NodeId> found;
    for (auto id = chain.rbegin(); id != chain.rend(); ++id) {
        const Node& n = scene.nodes[*id];
        world *= n.matrix ? *n.matrix : to_matrix(n.local);
        if (!found && !is_invertible(world)) found = *id;
    }
    const auto may_grow = [&](NodeId id) { return has_animated_scale(scene, id); };
    return found && std::ranges::none_of(chain, may_grow) ? found : std::nullopt;
}

}  // namespace foveray::scene
