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

/// One object of a scene file.
class ObjectReader {
  public:
    ObjectReader(SceneBuilder& builder, const SceneValues& values, const Json& json, const std::string& place)
        : builder_(builder), values_(values), json_(json), place_(place) {}

    void read() {
        Shape shape = read_shape();
        ShapeKindInfo kind = shape_kind(shape.kind);
        if (shape.kind == ShapeKind::User) kind.parameters = user_parameters(builder_.so_far(), shape);
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
        add_animation(builder_.add(std::move(node)), kind);
    }

  private:
    Shape read_shape() {
        const std::string name = json_["shape"];
        std::vector<std::string_view> names;
        for (const ShapeKindInfo& kind : shape_kinds()) {
            names.push_back(kind.name);
            if (kind.name != name) continue;
            if (kind.kind == ShapeKind::User) return user_shape();
            if (json_.contains("bounds")) {
                values_.fault(place_ + "/bounds", "only a user shape has them", "leave them out");
            }
            Shape shape;
            shape.kind = kind.kind;
            shape.values = default_values(kind.parameters);
            read_parameters(kind.parameters, shape.values);
            if (kind.kind == ShapeKind::Voxels) {
                const Shape voxels = read_voxel_object(builder_, values_, json_, place_);
                shape.voxels = voxels.voxels;
                shape.voxels_source = voxels.voxels_source;
            } else {
                refuse_voxel_keys();
            }
            if (kind.kind == ShapeKind::Blend) shape.blend_parts = blend_parts();
            if (kind.kind != ShapeKind::Blend && json_.contains("parts")) {
                values_.fault(place_ + "/parts", "only a blend shape has them", "leave them out");
            }
            if (kind.kind == ShapeKind::Csg) shape.solid = solid();
            if (kind.kind != ShapeKind::Csg && json_.contains("solid")) {
                values_.fault(place_ + "/solid", "only a csg shape has one", "leave it out");
            }
            return shape;
        }
        values_.fault(place_ + "/shape", "\"" + name + "\" is no shape", did_you_mean(name, names));
    }

    void refuse_voxel_keys() const {
        for (const char* key : {"voxelize", "voxel_size"}) {
            if (!json_.contains(key)) continue;
            values_.fault(place_ + "/" + key, "only a voxels shape has one", "leave it out");
        }
    }

    Shape user_shape() {
        Shape shape = read_user_object(builder_, values_, json_, place_);
        const std::vector<ShapeParameter> parameters = user_parameters(builder_.so_far(), shape);
        shape.values = default_values(parameters);
        read_parameters(parameters, shape.values);
        return shape;
    }

    std::vector<BlendPart> blend_parts() const {
        if (!json_.contains("parts")) {
            values_.fault(place_, "has no \"parts\"", "give some: docs/scene-format.md shows how");
        }
        return read_blend_parts(values_, json_["parts"], place_ + "/parts");
    }

    CsgSolid solid() {
        if (!json_.contains("solid")) {
            values_.fault(place_, "has no \"solid\"", "give one: docs/scene-format.md shows how");
        }
        return read_solid(builder_, values_, json_["solid"], place_ + "/solid");
    }

    void read_parameters(std::span<const ShapeParameter> parameters, std::vector<float>& into) {
        const Json given = json_.value("parameters", Json::object());
        for (const auto& [name, value] : given.items()) {
            const std::string place = place_ + "/parameters/" + name;
            const ShapeParameter& parameter = parameter_named(parameters, name, place);
            const std::vector<float> read = numbers(value, parameter, place);
            std::ranges::copy(read, into.begin() + *parameter_offset(parameters, name));
        }
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

    void add_animation(NodeId node, const ShapeKindInfo& kind) {
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
            animation.channels.push_back(channel(channels[i], place, node, kind));
        }
        if (!animation.channels.empty()) builder_.add(std::move(animation));
    }

    AnimationChannel channel(const Json& json, const std::string& place, NodeId node,
                             const ShapeKindInfo& kind) const {
        AnimationChannel c;
        c.node = node;
        const ShapeParameter property = animated(json["property"], place, kind, c);
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
    ShapeParameter animated(const std::string& name, const std::string& place, const ShapeKindInfo& kind,
                            AnimationChannel& channel) const {
        static const std::vector<ShapeParameter> transform = {
            {"translation", 3, vec4(0.0f), -1e6f, 1e6f},
            {"rotation", 4, vec4(0.0f), -1.0f, 1.0f},
            {"scale", 3, vec4(1.0f), 1e-6f, 1e6f},
        };
        std::vector<ShapeParameter> all = transform;
        all.insert(all.end(), kind.parameters.begin(), kind.parameters.end());
        const ShapeParameter found = parameter_named(all, name, place + "/property");
        channel.property = name == "translation" ? AnimatedProperty::Translation
                           : name == "rotation"  ? AnimatedProperty::Rotation
                           : name == "scale"     ? AnimatedProperty::Scale
                                                 : AnimatedProperty::ShapeValues;
        if (channel.property == AnimatedProperty::ShapeValues) {
            channel.first_value = *parameter_offset(kind.parameters, name);
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
