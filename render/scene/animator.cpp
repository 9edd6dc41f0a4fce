#include "render/scene/animator.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "render/scene/user_shape_object.h"

namespace foveray::scene {
namespace {

/// A cubic curve swings out of the range that its keys are in: shaders loop by these numbers.
void keep_in_range(const Scene& scene, const Shape& shape, std::vector<float>& values) {
    const std::vector<ShapeParameter>& parameters =
        shape.kind == ShapeKind::User ? user_parameters(scene, shape) : shape_kind(shape.kind).parameters;
    std::size_t i = 0;
    for (const ShapeParameter& p : parameters) {
        for (const std::size_t end = i + p.width; i < end; ++i)
            values[i] = std::clamp(values[i], p.least, p.most);
    }
}

/// What animations change of the nodes, starting from the scene as it was loaded.
struct Posed {
    std::vector<Transform> local;
    std::vector<std::vector<float>> morph_weights;
    std::vector<std::vector<float>> shape_values;
    std::vector<Material> materials;  // parallel to `animated`
};

/// Materials that an animation changes, in the order of their ids.
std::vector<MaterialId> animated_materials(const Scene& scene) {
    std::set<MaterialId> ids;
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) {
            if (is_of_material(channel.property)) ids.insert(channel.material);
        }
    }
    return {ids.begin(), ids.end()};
}

/// Splines may leave the range of what they go through.
float in_unit_range(float v) { return std::clamp(v, 0.0f, 1.0f); }

void apply(AnimatedProperty property, const std::vector<float>& v, Material& material) {
    switch (property) {
        case AnimatedProperty::BaseColor:
            material.base_color = vec4(glm::clamp(vec3(v[0], v[1], v[2]), 0.0f, 1.0f), material.base_color.a);
            break;
        case AnimatedProperty::Alpha:
            material.base_color.a = in_unit_range(v[0]);
            break;
        case AnimatedProperty::Metallic:
            material.metallic = in_unit_range(v[0]);
            break;
        case AnimatedProperty::Roughness:
            material.roughness = in_unit_range(v[0]);
            break;
        case AnimatedProperty::Emissive:
            material.emissive = glm::max(vec3(v[0], v[1], v[2]), 0.0f);
            break;
        case AnimatedProperty::Transmission:
            material.transmission = in_unit_range(v[0]);
            break;
        default:
            break;
    }
}

Posed pose_at(const Scene& scene, std::span<const MaterialState> animated, Nanoseconds time) {
    Posed posed;
    for (const MaterialState& state : animated) posed.materials.push_back(scene.materials[state.material]);
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
            if (is_of_material(channel.property)) {
                const auto at = std::ranges::find(animated, channel.material, &MaterialState::material);
                apply(channel.property, v, posed.materials[static_cast<std::size_t>(at - animated.begin())]);
                continue;
            }
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
                default:
                    break;
            }
        }
    }
    for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
        if (scene.shapes[id].animated) keep_in_range(scene, scene.shapes[id], posed.shape_values[id]);
    }
    return posed;
}

/// In what animations change.
bool same_values(const Material& a, const Material& b) {
    return a.base_color == b.base_color && a.metallic == b.metallic && a.roughness == b.roughness &&
           a.emissive == b.emissive && a.transmission == b.transmission;
}

vec3 axis_or(vec3 v, vec3 fallback) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : fallback;
}

bool is_there(const Node& node, Nanoseconds time) {
    const auto holds = [&](const Presence& p) { return p.from <= time && time < p.until; };
    return node.present.empty() || std::ranges::any_of(node.present, holds);
}

void place_lights(const Scene& scene, std::span<const std::uint8_t> present, SceneChanges& state) {
    state.lights.clear();
    state.area_lights.clear();
    std::uint32_t area_number = 0, number = 0;
    for (const Node& node : scene.nodes) number += node.area_light.has_value();
    for (NodeId id = 0; id < scene.nodes.size(); ++id) {
        const Node& node = scene.nodes[id];
        const mat4& world = state.world_from_node[id];
        const std::uint32_t light_number = number, area_light_number = area_number;
        number += node.light.has_value();
        area_number += node.area_light.has_value();
        if (!present[id]) continue;
        if (node.light) {
            const Light& light = scene.lights[*node.light];
            state.lights.push_back({.kind = light.kind,
                                    .position = vec3(world[3]),
                                    .direction = axis_or(-vec3(world[2]), vec3(0, 0, -1)),
                                    .intensity = light.intensity,
                                    .range = light.range,
                                    .cos_inner_cone = std::cos(light.inner_cone),
                                    .cos_outer_cone = std::cos(light.outer_cone),
                                    .number = light_number});
        }
        if (node.area_light) {
            const AreaLight& light = scene.area_lights[*node.area_light];
            state.area_lights.push_back({.shape = light.shape,
                                         .center = vec3(world[3]),
                                         .half_u = light.half_size.x * vec3(world[0]),
                                         .half_v = -light.half_size.y * vec3(world[1]),
                                         .half_w = -light.half_size.z * vec3(world[2]),
                                         .radiance = light.radiance,
                                         .number = area_light_number});
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
    for (const MaterialId id : animated_materials(scene)) state_.materials.push_back({id, {}, false});
    present_.resize(scene.nodes.size());
}

const SceneChanges& SceneAnimator::advance(Nanoseconds time) {
    const Scene& scene = *scene_;
    const bool first = !started_;
    started_ = true;
    Posed posed = pose_at(scene, state_.materials, time);
    state_.time = time;

    state_.previous_world_from_node = state_.world_from_node;
    for (NodeId id = 0; id < scene.nodes.size(); ++id) {
        const Node& node = scene.nodes[id];
        const mat4 local = node.matrix ? *node.matrix : to_matrix(posed.local[id]);
        state_.world_from_node[id] = node.parent ? state_.world_from_node[*node.parent] * local : local;
        present_[id] = is_there(node, time) && (!node.parent || present_[*node.parent]);
    }
    if (first) state_.previous_world_from_node = state_.world_from_node;

    state_.transforms_changed = first;
    const auto move = [&](InstanceState& s, NodeId node, const mat4& world_from_object) {
        const bool was_present = s.present;
        s.present = present_[node] != 0;
        const bool stayed = !first && was_present && s.present;
        s.previous_world_from_object = stayed ? s.world_from_object : world_from_object;
        s.world_from_object = world_from_object;
        s.moved = s.world_from_object != s.previous_world_from_object;
        state_.transforms_changed |= s.moved || was_present != s.present;
    };
    for (InstanceId id = 0; id < scene.instances.size(); ++id) {
        const Instance& instance = scene.instances[id];
        const bool skinned = instance.deformation && scene.deformations[*instance.deformation].skin;
        move(state_.instances[id], instance.node,
             skinned ? mat4(1.0f) : state_.world_from_node[instance.node] * instance.node_from_object);
    }
    for (ShapeInstanceId id = 0; id < scene.shape_instances.size(); ++id) {
        const ShapeInstance& instance = scene.shape_instances[id];
        move(state_.shape_instances[id], instance.node,
             state_.world_from_node[instance.node] * instance.node_from_object);
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
    for (std::size_t i = 0; i < state_.materials.size(); ++i) {
        MaterialState& s = state_.materials[i];
        s.changed = first || !same_values(s.values, posed.materials[i]);
        s.values = std::move(posed.materials[i]);
    }
    place_lights(scene, present_, state_);
    return state_;
}

}  // namespace foveray::scene
