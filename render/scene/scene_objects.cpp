#include "render/scene/scene_objects.h"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "base/text.h"
#include "render/scene/scene_blend.h"
#include "render/scene/scene_material.h"
#include "render/scene/scene_solid.h"
#include "render/scene/user_shape_object.h"
#include "render/scene/voxel_object.h"

namespace foveray::scene {
namespace {

std::string list_of(std::span<const std::string_view> names) {
    std::string list;
    for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> names) {
    if (names.empty()) return "leave it out";
    return "did you mean \"" + std::string(nearest(word, names)) + "\"? There are " + list_of(names);
}

/// A key that objects of one kind alone have.
struct OwnKey {
    const char* name;
    ShapeKind kind;
    const char* pronoun;
};

constexpr OwnKey own_keys[] = {{"bounds", ShapeKind::User, "them"},
                               {"parts", ShapeKind::Blend, "them"},
                               {"solid", ShapeKind::Csg, "one"},
                               {"voxelize", ShapeKind::Voxels, "one"},
                               {"voxel_size", ShapeKind::Voxels, "one"}};

/// One object of a scene file.
class ObjectReader {
  public:
    ObjectReader(SceneBuilder& builder, const SceneValues& values, const Json& json, const std::string& place)
        : builder_(builder), values_(values), json_(json), place_(place) {}

    void read() {
        const ShapeKindInfo& kind = wanted_kind();
        refuse_keys_of_other_kinds(kind.kind);
        Shape shape = read_shape(kind.kind);
        const std::vector<ShapeParameter> parameters =
            kind.kind == ShapeKind::User ? user_parameters(builder_.so_far(), shape) : kind.parameters;
        shape.values = parameter_values(parameters);
        Node node;
        node.name = json_.value("name", std::string(kind.name));
        node.parent = parent();
        if (json_.contains("transform")) {
            node.local = values_.transform(json_["transform"], place_ + "/transform");
        }
        const Json instances = json_.value("instances", Json::array());
        for (std::size_t i = 0; i < instances.size(); ++i) {
            node.mesh_instances.push_back(
                values_.transform(instances[i], place_ + "/instances/" + std::to_string(i)));
        }
        shape.name = node.name;
        shape.material = builder_.add(material());
        node.shape = builder_.add(std::move(shape));
        add_animation(builder_.add(std::move(node)), parameters);
    }

  private:
    const ShapeKindInfo& wanted_kind() const {
        const std::string name = json_["shape"];
        std::vector<std::string_view> names;
        for (const ShapeKindInfo& kind : shape_kinds()) {
            if (kind.name == name) return kind;
            names.push_back(kind.name);
        }
        values_.fault(place_ + "/shape", "\"" + name + "\" is no shape", did_you_mean(name, names));
    }

    void refuse_keys_of_other_kinds(ShapeKind kind) const {
        for (const OwnKey& key : own_keys) {
            if (key.kind == kind || !json_.contains(key.name)) continue;
            values_.fault(place_ + "/" + key.name,
                          fmt::format("only a {} shape has {}", shape_kind(key.kind).name, key.pronoun),
                          "leave the key out");
        }
    }

    /// Still without the parameters' values.
    Shape read_shape(ShapeKind kind) {
        if (kind == ShapeKind::User) return read_user_object(builder_, values_, json_, place_);
        if (kind == ShapeKind::Voxels) return read_voxel_object(builder_, values_, json_, place_);
        Shape shape;
        shape.kind = kind;
        if (kind == ShapeKind::Blend) {
            shape.blend_parts = read_blend_parts(values_, needed("parts"), place_ + "/parts");
        }
        if (kind == ShapeKind::Csg) {
            shape.solid = read_solid(builder_, values_, needed("solid"), place_ + "/solid");
        }
        return shape;
    }

    const Json& needed(const char* key) const {
        if (!json_.contains(key)) {
            values_.fault(place_, fmt::format("has no \"{}\"", key), "see docs/scene-format.md");
        }
        return json_[key];
    }

    std::vector<float> parameter_values(std::span<const ShapeParameter> parameters) const {
        std::vector<float> result = default_values(parameters);
        const Json given = json_.value("parameters", Json::object());
        for (const auto& [name, value] : given.items()) {
            const std::string place = place_ + "/parameters/" + name;
            const ShapeParameter& parameter = parameter_named(parameters, name, place);
            std::ranges::copy(numbers(value, parameter, place),
                              result.begin() + *parameter_offset(parameters, name));
        }
        return result;
    }

    const ShapeParameter& parameter_named(std::span<const ShapeParameter> parameters, const std::string& name,
                                          const std::string& place) const {
        std::vector<std::string_view> names;
        for (const ShapeParameter& p : parameters) {
            if (p.name == name) return p;
            names.push_back(p.name);
        }
        values_.fault(place, "is no parameter of this shape", did_you_mean(name, names));
    }

    /// A parameter's value, in its range.
    std::vector<float> numbers(const Json& value, const ShapeParameter& parameter,
                               const std::string& place) const {
        const Json list = value.is_array() ? value : Json::array({value});
        if (list.size() != parameter.width) {
            values_.fault(place, "has " + std::to_string(list.size()) + " numbers",
                          "give " + std::to_string(parameter.width));
        }
        std::vector<float> result;
        for (const Json& number : list) {
            result.push_back(number.get<float>());
            if (result.back() >= parameter.least && result.back() <= parameter.most) continue;
            values_.fault(place, number.dump() + " is out of range",
                          fmt::format("give {} to {}", parameter.least, parameter.most));
        }
        const bool no_length = std::ranges::all_of(result, [](float x) { return std::abs(x) < 1e-3f; });
        if (parameter.rotation && no_length) {
            values_.fault(place, "is no rotation", "give a quaternion x, y, z, w");
        }
        return result;
    }

    Material material() const {
        return read_material(values_, json_.value("material", Json::object()),
                             json_.value("name", json_["shape"].get<std::string>()), place_ + "/material");
    }

    std::optional<NodeId> parent() const {
        if (!json_.contains("parent")) return std::nullopt;
        const std::string wanted = json_["parent"];
        const std::vector<Node>& nodes = builder_.so_far().nodes;
        std::optional<NodeId> found;
        std::vector<std::string_view> names;
        for (NodeId id = 0; id < nodes.size(); ++id) {
            if (!nodes[id].name.empty()) names.push_back(nodes[id].name);
            if (nodes[id].name != wanted) continue;
            if (found)
                values_.fault(place_ + "/parent", "several nodes are called \"" + wanted + "\"",
                              "rename one");
            found = id;
        }
        if (!found) {
            values_.fault(place_ + "/parent", "no node before this object is called \"" + wanted + "\"",
                          did_you_mean(wanted, names));
        }
        return found;
    }

    void add_animation(NodeId node, std::span<const ShapeParameter> parameters) {
        const Json channels = json_.value("animation", Json::array());
        Animation animation;
        animation.name = json_.value("name", "object");
        std::vector<std::string> moved;
        for (std::size_t i = 0; i < channels.size(); ++i) {
            const std::string place = place_ + "/animation/" + std::to_string(i);
            const std::string property = channels[i]["property"];
            if (std::ranges::find(moved, property) != moved.end()) {
                values_.fault(place + "/property", "\"" + property + "\" is animated twice",
                              "keep one of them");
            }
            moved.push_back(property);
            animation.channels.push_back(channel(channels[i], place, node, parameters));
        }
        if (!animation.channels.empty()) builder_.add(std::move(animation));
    }

    AnimationChannel channel(const Json& json, const std::string& place, NodeId node,
                             std::span<const ShapeParameter> parameters) const {
        AnimationChannel c;
        c.node = node;
        const ShapeParameter property = animated(json["property"], place, parameters, c);
        c.width = property.width;
        const std::string way = json.value("interpolation", "linear");
        c.interpolation = way == "step"    ? Interpolation::Step
                          : way == "cubic" ? Interpolation::CubicSpline
                                           : Interpolation::Linear;
        for (const Json& time : json["times"]) {
            c.times.push_back(time.get<float>());
            const bool increasing = c.times.size() < 2 || c.times.back() > c.times[c.times.size() - 2];
            if (!increasing || !std::isfinite(c.times.back())) {
                values_.fault(place + "/times", "do not increase from key to key", "correct them");
            }
        }
        const Json& keys = json["values"];
        const std::size_t wanted = c.times.size() * (c.interpolation == Interpolation::CubicSpline ? 3 : 1);
        if (keys.size() != wanted) {
            values_.fault(place + "/values", "has " + std::to_string(keys.size()) + " values",
                          "give " + std::to_string(wanted) +
                              ": one a time, or for cubic in-tangent, value and out-tangent");
        }
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const bool tangent = c.interpolation == Interpolation::CubicSpline && i % 3 != 1;
            ShapeParameter range = property;
            if (tangent) range.least = -1e30f, range.most = 1e30f;
            const std::vector<float> v = numbers(keys[i], range, place + "/values/" + std::to_string(i));
            c.values.insert(c.values.end(), v.begin(), v.end());
        }
        return c;
    }

    /// What the channel moves, with the width and range of its values.
    ShapeParameter animated(const std::string& name, const std::string& place,
                            std::span<const ShapeParameter> parameters, AnimationChannel& channel) const {
        static const std::vector<ShapeParameter> transform = {
            {"translation", 3, vec4(0.0f), -1e6f, 1e6f},
            {"rotation", 4, vec4(0.0f), -1.0f, 1.0f},
            {"scale", 3, vec4(1.0f), 1e-6f, 1e6f},
        };
        std::vector<ShapeParameter> all = transform;
        all.insert(all.end(), parameters.begin(), parameters.end());
        const ShapeParameter found = parameter_named(all, name, place + "/property");
        channel.property = name == "translation" ? AnimatedProperty::Translation
                           : name == "rotation"  ? AnimatedProperty::Rotation
                           : name == "scale"     ? AnimatedProperty::Scale
                                                 : AnimatedProperty::ShapeValues;
        if (channel.property == AnimatedProperty::ShapeValues) {
            channel.first_value = *parameter_offset(parameters, name);
        }
        return found;
    }

    SceneBuilder& builder_;
    const SceneValues& values_;
    const Json& json_;
    const std::string& place_;
};

}  // namespace

void add_object(SceneBuilder& builder, const SceneValues& values, const Json& object,
                const std::string& place) {
    ObjectReader(builder, values, object, place).read();
}

}  // namespace foveray::scene
