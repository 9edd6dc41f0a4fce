#include "render/scene/scene_objects.h"

#include <array>

#include <spdlog/fmt/fmt.h>

#include "render/scene/mesh_object.h"
#include "render/scene/scene_animation.h"
#include "render/scene/scene_blend.h"
#include "render/scene/scene_material.h"
#include "render/scene/scene_parameters.h"
#include "render/scene/scene_solid.h"
#include "render/scene/singular.h"
#include "render/scene/user_shape_object.h"
#include "render/scene/voxel_object.h"

namespace foveray::scene {
namespace {

constexpr std::array shape_keys = {"parameters", "material", "file",  "voxelize",
                                   "voxel_size", "parts",    "solid", "bounds"};

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
        if (json_.contains("mesh") == json_.contains("shape")) {
            values_.fault(place_, "has no \"shape\" or \"mesh\", or both", "give one of them");
        }
        json_.contains("mesh") ? read_mesh() : read_shape_object();
    }

  private:
    void read_mesh() {
        for (const char* key : shape_keys) {
            if (!json_.contains(key)) continue;
            values_.fault(place_ + "/" + key, "only a shape has it", "leave it out, or say it of a part");
        }
        Node node = read_node("mesh");
        node.mesh =
            builder_.add(read_mesh_parts(builder_, values_, json_["mesh"], node.name, place_ + "/mesh"));
        add_node(std::move(node), {});
    }

    void read_shape_object() {
        const ShapeKindInfo& kind = wanted_kind();
        refuse_keys_of_other_kinds(kind.kind);
        Shape shape = read_shape(kind.kind);
        const std::vector<ShapeParameter> parameters =
            kind.kind == ShapeKind::User ? user_parameters(builder_.so_far(), shape) : kind.parameters;
        shape.values = default_values(parameters);
        read_parameters(values_, json_, place_, parameters, shape.values);
        Node node = read_node(kind.name);
        shape.name = node.name;
        shape.material = add_material();
        node.shape = builder_.add(std::move(shape));
        add_node(std::move(node), parameters);
    }

    void add_node(Node node, const std::vector<ShapeParameter>& parameters) {
        const NodeId id = builder_.add(std::move(node));
        add_animation(builder_, values_, json_, place_, id, parameters);
        const std::optional<NodeId> flat = flattened_by(builder_.so_far(), id);
        if (!flat) return;
        if (*flat == id) {
            values_.fault(place_ + "/transform",
                          "leaves nothing of the object: all scales together are too small",
                          "give it or its parents larger ones");
        }
        values_.fault(
            place_ + "/parent",
            "the transform of \"" + builder_.so_far().nodes[*flat].name + "\" flattens what hangs on it",
            "give that node a scale other than 0");
    }

    Node read_node(std::string_view kind) const {
        Node node;
        node.name = json_.value("name", std::string(kind));
        node.parent = parent();
        node.present = read_presence(values_, json_, place_);
        if (json_.contains("transform")) {
            node.local = values_.transform(json_["transform"], place_ + "/transform");
        }
        const Json instances = json_.value("instances", Json::array());
        for (std::size_t i = 0; i < instances.size(); ++i) {
            node.mesh_instances.push_back(
                values_.transform(instances[i], place_ + "/instances/" + std::to_string(i)));
        }
        return node;
    }

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
        if (json_.contains("file") && kind != ShapeKind::User && kind != ShapeKind::Voxels) {
            values_.fault(place_ + "/file", "only user and voxels shapes have one", "leave the key out");
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

    MaterialId add_material() {
        const Json material = json_.value("material", Json::object());
        const std::string at = place_ + "/material";
        return scene::add_material(
            builder_, values_, material,
            read_material(values_, material, json_.value("name", json_["shape"].get<std::string>()), at), at);
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
