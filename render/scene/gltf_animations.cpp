#include "render/scene/gltf_animations.h"

#include <optional>
#include <set>

namespace foveray::scene {
namespace {

std::optional<AnimatedProperty> property_of(const std::string& path) {
    if (path == "translation") return AnimatedProperty::Translation;
    if (path == "rotation") return AnimatedProperty::Rotation;
    if (path == "scale") return AnimatedProperty::Scale;
    if (path == "weights") return AnimatedProperty::Weights;
    return std::nullopt;
}

Interpolation interpolation_of(const GltfDocument& document, const std::string& name,
                               const std::string& place) {
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
    if (name != "LINEAR") document.fault(place + "/interpolation", "must be STEP, LINEAR or CUBICSPLINE");
    return Interpolation::Linear;
}

std::uint32_t width_of(const SceneBuilder& builder, NodeId node, AnimatedProperty property) {
    switch (property) {
        case AnimatedProperty::Translation:
        case AnimatedProperty::Scale:
            return 3;
        case AnimatedProperty::Rotation:
            return 4;
        case AnimatedProperty::Weights:
        default:
            break;
    }
    const Scene& scene = builder.so_far();
    const std::optional<MeshId> mesh = scene.nodes[node].mesh;
    return mesh ? static_cast<std::uint32_t>(scene.meshes[*mesh].morph_weights.size()) : 0;
}

void read_keys(AnimationChannel& channel, const GltfDocument& document,
               const tinygltf::AnimationSampler& sampler, const std::string& place) {
    channel.times = read_floats(document, sampler.input, 1, place + "/input");
    for (std::size_t i = 1; i < channel.times.size(); ++i) {
        if (channel.times[i] <= channel.times[i - 1])
            document.fault(place + "/input", "must increase from key to key");
    }
    channel.interpolation = interpolation_of(document, sampler.interpolation, place);
    const std::uint32_t width = channel.property == AnimatedProperty::Weights
                                    ? 1
                                    : channel.width;  // weights are scalars, one after another
    channel.values = read_floats(document, sampler.output, width, place + "/output");
    const std::size_t values_a_key = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
    if (channel.values.size() != channel.times.size() * values_a_key * channel.width) {
        document.fault(place + "/output",
                       "must have one value (three for CUBICSPLINE) for each key of its input");
    }
}

}  // namespace

void add_animations(SceneBuilder& builder, const GltfDocument& document, const std::map<int, NodeId>& nodes) {
    std::set<std::pair<NodeId, AnimatedProperty>> moved;
    for (std::size_t i = 0; i < document.model.animations.size(); ++i) {
        const tinygltf::Animation& parsed = document.model.animations[i];
        const std::string place = "/animations/" + std::to_string(i);
        Animation animation;
        animation.name = parsed.name;
        bool conflict = false;
        std::set<std::pair<NodeId, AnimatedProperty>> moves;
        for (const tinygltf::AnimationChannel& c : parsed.channels) {
            const auto node = nodes.find(c.target_node);
            const auto property = property_of(c.target_path);
            if (node == nodes.end() || !property) continue;  // another scene's, or an extension's
            AnimationChannel channel;
            channel.node = node->second;
            channel.property = *property;
            channel.width = width_of(builder, node->second, *property);
            if (channel.width == 0) continue;
            read_keys(channel, document, parsed.samplers[static_cast<std::size_t>(c.sampler)],
                      place + "/samplers/" + std::to_string(c.sampler));
            moves.emplace(channel.node, channel.property);
            conflict |= moved.contains({channel.node, channel.property});
            animation.channels.push_back(std::move(channel));
        }
        if (conflict) {
            builder.warn(document.file.string() + ": " + place + " (" + parsed.name +
                         ") moves what an earlier animation moves; it does not play");
        } else if (!animation.channels.empty()) {
            moved.merge(moves);
            builder.add(std::move(animation));
        }
    }
}

}  // namespace foveray::scene
