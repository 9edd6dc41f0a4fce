#include "render/scene/scene_solid.h"

#include <array>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "render/scene/scene_material.h"
#include "render/scene/shape.h"

namespace foveray::scene {
namespace {

constexpr std::array operations = {"union", "intersection", "difference"};  // as CsgOperation

class SolidReader {
  public:
    SolidReader(SceneBuilder& builder, const SceneValues& values) : builder_(builder), values_(values) {}

    /// What a node says holds for all below it: transforms multiply, the innermost material counts.
    void read(const Json& json, const std::string& place, mat4 object_from_node,
              std::optional<MaterialId> material) {
        const std::string key = only_key(json, place);
        if (json.contains("transform")) {
            object_from_node =
                object_from_node * to_matrix(values_.transform(json["transform"], place + "/transform"));
        }
        if (json.contains("material")) {
            const std::string at = place + "/material";
            material = add_material(builder_, values_, json["material"],
                                    read_material(values_, json["material"], "part of a solid", at), at);
        }
        const Json& inner = json[key];
        for (std::size_t i = 0; i < operations.size(); ++i) {
            if (key != operations[i]) continue;
            for (std::size_t k = 0; k < inner.size(); ++k) {
                read(inner[k], place + "/" + key + "/" + std::to_string(k), object_from_node, material);
                if (k > 0) solid_.program.push_back({static_cast<CsgOperation>(i), 0});
            }
            return;
        }
        add_leaf(key, inner, place, object_from_node, material);
    }

    CsgSolid take() { return std::move(solid_); }

  private:
    /// The one key that says what the node is.
    std::string only_key(const Json& json, const std::string& place) const {
        std::string found;
        for (const auto& [key, value] : json.items()) {
            if (key == "transform" || key == "material") continue;
            if (!found.empty()) {
                values_.fault(place, "is \"" + found + "\" and \"" + key + "\" at once",
                              "keep one of them; join several with union");
            }
            found = key;
        }
        if (found.empty()) {
            values_.fault(place, "is no solid",
                          "give one of sphere, box, cylinder, union, intersection, difference");
        }
        return found;
    }

    void add_leaf(const std::string& key, const Json& json, const std::string& place,
                  const mat4& object_from_node, std::optional<MaterialId> material) {
        if (solid_.leaves.size() == CsgSolid::most_leaves) {
            values_.fault(place, fmt::format("the solid has more than {} leaves", CsgSolid::most_leaves),
                          "make two objects of it");
        }
        const std::string inside = place + "/" + key;
        CsgLeaf leaf;
        vec3 size;
        if (key == "box") {
            leaf.primitive = CsgPrimitive::Box;
            size = values_.triple(json, "half_size", inside, vec3(0.5f));
        } else {
            leaf.primitive = key == "sphere" ? CsgPrimitive::Sphere : CsgPrimitive::Cylinder;
            size = vec3(values_.number(json, "radius", inside, 0.5f));
            if (key == "cylinder") size.y = values_.number(json, "half_height", inside, 0.5f);
        }
        leaf.object_from_leaf = object_from_node * glm::scale(mat4(1.0f), size);
        leaf.material = material;
        check_size(leaf.object_from_leaf, place);
        solid_.program.push_back({std::nullopt, static_cast<std::uint32_t>(solid_.leaves.size())});
        solid_.leaves.push_back(leaf);
    }

    /// Sizes multiply on the way down; rays must be able to go the way back.
    void check_size(const mat4& object_from_leaf, const std::string& place) const {
        const mat3 linear(object_from_leaf);
        float volume = 1.0f;
        for (int axis = 0; axis < 3; ++axis) {
            const float length = glm::length(linear[axis]);
            if (!(length >= smallest_shape && length <= largest_shape)) {
                values_.fault(place, fmt::format("this leaf's half-size is {} with all transforms", length),
                              fmt::format("bring it to {} to {}", smallest_shape, largest_shape));
            }
            volume *= length;
        }
        const vec3 center(object_from_leaf[3]);
        if (!(glm::length(center) <= 10.0f * largest_shape)) {
            values_.fault(place, "this leaf is too far from the object's origin", "move the object instead");
        }
        if (!(std::abs(glm::determinant(linear)) > 1e-5f * volume)) {
            values_.fault(place, "this leaf is flat: its transforms cannot be undone", "correct their scale");
        }
    }

    SceneBuilder& builder_;
    const SceneValues& values_;
    CsgSolid solid_;
};

}  // namespace

CsgSolid read_solid(SceneBuilder& builder, const SceneValues& values, const Json& json,
                    const std::string& place) {
    SolidReader reader(builder, values);
    reader.read(json, place, mat4(1.0f), std::nullopt);
    CsgSolid solid = reader.take();
    if (bounds_of(solid).empty()) {
        values.fault(place, "nothing is left of this solid: an intersection's parts do not meet",
                     "correct their places");
    }
    return solid;
}

}  // namespace foveray::scene
