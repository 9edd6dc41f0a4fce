#include "render/scene/animator.h"

#include <algorithm>
#include <cmath>

namespace foveray::scene {
namespace {

/// What animations change of the nodes, starting from the scene as it was loaded.
struct Posed {
    std::vector<Transform> local;
    std::vector<std::vector<float>> morph_weights;
    std::vector<std::vector<float>> shape_values;
};

Posed pose_at(const Scene& scene, Nanoseconds time) {
    Posed posed;
    for (const Node& node : scene.nodes) {
        posed.local.push_back(node.local);
        posed.morph_weights.push_back(node.morph_weights.empty() && node.mesh
                                          ? scene.meshes[*node.mesh].morph_weights
                                          : node.morph_weights);
    }
    for (const Shape& shape : scene.shapes) posed.shape_values.push_back(shape.values);
    for (const Animation& animation : scene.animations) {
        const double duration = animation.duration;
        const double loop =
            duration > 0.0 ? to_seconds(time) - duration * std::floor(to_seconds(time) / duration) : 0.0;
        for (const AnimationChannel& channel : animation.channels) {
            const std::vector<float> v = sample(channel, static_cast<float>(loop));
            Transform& local = posed.local[channel.node];
            switch (channel.property) {
                case AnimatedProperty::Translation:
                    local.translation = {v[0], v[1], v[2]};
                    break;
                case AnimatedProperty::Rotation:
                    local.rotation = {v[3], v[0], v[1], v[2]};
                    break;
                case AnimatedProperty::Scale:
                    local.scale = {v[0], v[1], v[2]};
                    break;
                case AnimatedProperty::Weights:
                    posed.morph_weights[channel.node] = v;
                    break;
                case AnimatedProperty::ShapeValues:
                    std::ranges::copy(v, posed.shape_values[*scene.nodes[channel.node].shape].begin() +
                                             channel.first_value);
                    break;
            }
        }
    }
    return posed;
}

vec3 axis_or(vec3 v, vec3 fallback) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : fallback;
}

void place_lights(const Scene& scene, SceneChanges& state) {
    state.lights.clear();
    state.area_lights.clear();
    for (NodeId id = 0; id < scene.nodes.size(); ++id) {
        const Node& node = scene.nodes[id];
        const mat4& world = state.world_from_node[id];
        if (node.light) {
            const Light& light = scene.lights[*node.light];
            state.lights.push_back({.kind = light.kind,
                                    .position = vec3(world[3]),
                                    .direction = axis_or(-vec3(world[2]), vec3(0, 0, -1)),
                                    .intensity = light.intensity,
                                    .range = light.range,
                                    .cos_inner_cone = std::cos(light.inner_cone),
                                    .cos_outer_cone = std::cos(light.outer_cone)});
        }
        if (node.area_light) {
            const AreaLight& light = scene.area_lights[*node.area_light];
            state.area_lights.push_back({.shape = light.shape,
                                         .center = vec3(world[3]),
                                         .half_u = light.half_size.x * vec3(world[0]),
                                         .half_v = -light.half_size.y * vec3(world[1]),
                                         .half_w = -light.half_size.z * vec3(world[2]),
                                         .radiance = light.radiance});
        }
    }
}

}  // namespace

SceneAnimator::SceneAnimator(const Scene& scene) : scene_(&scene) {
    state_.world_from_node.resize(scene.nodes.size());
    state_.instances.resize(scene.instances.size());
    state_.shape_instances.resize(scene.shape_instances.size());
    state_.deformations.resize(scene.deformations.size());
    state_.shapes.resize(scene.shapes.size());
}

const SceneChanges& SceneAnimator::advance(Nanoseconds time) {
    const Scene& scene = *scene_;
    const bool first = !started_;
    started_ = true;
    const Posed posed = pose_at(scene, time);
    state_.time = time;

    state_.previous_world_from_node = state_.world_from_node;
    for (NodeId id = 0; id < scene.nodes.size(); ++id) {
        const Node& node = scene.nodes[id];
        const mat4 local = node.matrix ? *node.matrix : to_matrix(posed.local[id]);
        state_.world_from_node[id] = node.parent ? state_.world_from_node[*node.parent] * local : local;
    }
    if (first) state_.previous_world_from_node = state_.world_from_node;

    state_.transforms_changed = first;
    const auto move = [&](InstanceState& s, const mat4& world_from_object) {
        s.previous_world_from_object = first ? world_from_object : s.world_from_object;
        s.world_from_object = world_from_object;
        s.moved = s.world_from_object != s.previous_world_from_object;
        state_.transforms_changed |= s.moved;
    };
    for (InstanceId id = 0; id < scene.instances.size(); ++id) {
        const Instance& instance = scene.instances[id];
        const bool skinned = instance.deformation && scene.deformations[*instance.deformation].skin;
        move(state_.instances[id],
             skinned ? mat4(1.0f) : state_.world_from_node[instance.node] * instance.node_from_object);
    }
    for (ShapeInstanceId id = 0; id < scene.shape_instances.size(); ++id) {
        const ShapeInstance& instance = scene.shape_instances[id];
        move(state_.shape_instances[id], state_.world_from_node[instance.node] * instance.node_from_object);
    }
    for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
        ShapeState& s = state_.shapes[id];
        s.changed = first ? scene.shapes[id].animated : s.values != posed.shape_values[id];
        if (!first && !s.changed) continue;
        s.values = posed.shape_values[id];
        s.bounds = bounds_of(scene.shapes[id], s.values);
    }

    for (DeformationId id = 0; id < scene.deformations.size(); ++id) {
        const Deformation& deformation = scene.deformations[id];
        DeformationState& s = state_.deformations[id];
        s.previous_joints = std::move(s.joints);
        s.previous_morph_weights = std::move(s.morph_weights);
        s.joints.clear();
        if (deformation.skin) {
            const Skin& skin = scene.skins[*deformation.skin];
            for (std::size_t j = 0; j < skin.joints.size(); ++j) {
                s.joints.push_back(state_.world_from_node[skin.joints[j]] * skin.inverse_bind[j]);
            }
        }
        s.morph_weights = posed.morph_weights[deformation.node];
        if (first) {
            s.previous_joints = s.joints;
            s.previous_morph_weights = s.morph_weights;
        }
        s.changed = first || s.joints != s.previous_joints || s.morph_weights != s.previous_morph_weights;
    }
    place_lights(scene, state_);
    return state_;
}

}  // namespace foveray::scene
