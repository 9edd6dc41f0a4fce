#include "render/scene/gltf_references.h"

#include <array>
#include <functional>
#include <string_view>

namespace foveray::scene {
namespace {

/// A property that holds an index, and the array that it points into. "*" stands for every element or member.
struct Reference {
    std::string_view place, target;
};

constexpr std::string_view lights = "/extensions/KHR_lights_punctual/lights";

constexpr std::array references = {
    Reference{"/scene", "/scenes"},
    Reference{"/scenes/*/nodes/*", "/nodes"},
    Reference{"/nodes/*/children/*", "/nodes"},
    Reference{"/nodes/*/mesh", "/meshes"},
    Reference{"/nodes/*/skin", "/skins"},
    Reference{"/nodes/*/camera", "/cameras"},
    Reference{"/nodes/*/extensions/KHR_lights_punctual/light", lights},
    Reference{"/nodes/*/extensions/EXT_mesh_gpu_instancing/attributes/*", "/accessors"},
    Reference{"/meshes/*/primitives/*/material", "/materials"},
    Reference{"/meshes/*/primitives/*/indices", "/accessors"},
    Reference{"/meshes/*/primitives/*/attributes/*", "/accessors"},
    Reference{"/meshes/*/primitives/*/targets/*/*", "/accessors"},
    Reference{"/materials/*/pbrMetallicRoughness/baseColorTexture/index", "/textures"},
    Reference{"/materials/*/pbrMetallicRoughness/metallicRoughnessTexture/index", "/textures"},
    Reference{"/materials/*/normalTexture/index", "/textures"},
    Reference{"/materials/*/occlusionTexture/index", "/textures"},
    Reference{"/materials/*/emissiveTexture/index", "/textures"},
    Reference{"/textures/*/source", "/images"},
    Reference{"/textures/*/sampler", "/samplers"},
    Reference{"/images/*/bufferView", "/bufferViews"},
    Reference{"/skins/*/joints/*", "/nodes"},
    Reference{"/skins/*/inverseBindMatrices", "/accessors"},
    Reference{"/animations/*/samplers/*/input", "/accessors"},
    Reference{"/animations/*/samplers/*/output", "/accessors"},
    Reference{"/animations/*/channels/*/target/node", "/nodes"},
    Reference{"/accessors/*/bufferView", "/bufferViews"},
    Reference{"/accessors/*/sparse/indices/bufferView", "/bufferViews"},
    Reference{"/accessors/*/sparse/values/bufferView", "/bufferViews"},
    Reference{"/bufferViews/*/buffer", "/buffers"},
};

using Visit = std::function<void(const Json& value, const std::string& place)>;

/// Calls `visit` for each value that `pattern` (a JSON pointer with "*") finds under `value`.
void visit_matches(const Json& value, std::string_view pattern, const std::string& place,
                   const Visit& visit) {
    if (pattern.empty()) return visit(value, place);
    const std::size_t end = pattern.find('/', 1);
    const std::string step(pattern.substr(1, end == pattern.npos ? end : end - 1));
    const std::string_view rest = end == pattern.npos ? std::string_view() : pattern.substr(end);
    if (step != "*") {
        if (value.is_object() && value.contains(step))
            visit_matches(value[step], rest, place + "/" + step, visit);
    } else if (value.is_object() || value.is_array()) {
        for (const auto& [key, element] : value.items())
            visit_matches(element, rest, place + "/" + key, visit);
    }
}

std::size_t length(const Json& json, std::string_view pointer) {
    const Json::json_pointer place{std::string(pointer)};
    return json.contains(place) && json[place].is_array() ? json[place].size() : 0;
}

void check_shapes(const GltfDocument& document) {
    constexpr std::array arrays = {"accessors", "animations", "buffers", "bufferViews", "cameras",
                                   "images",    "materials",  "meshes",  "nodes",       "samplers",
                                   "scenes",    "skins",      "textures"};
    for (const std::string key : arrays) {
        const Json value = document.json.value(key, Json::array());
        if (!value.is_array()) document.fault("/" + key, "must be an array");
        for (std::size_t i = 0; i < value.size(); ++i) {
            if (!value[i].is_object())
                document.fault("/" + key + "/" + std::to_string(i), "must be an object");
        }
    }
}

void check_tree(const GltfDocument& document) {
    const std::size_t count = length(document.json, "/nodes");
    std::vector<std::size_t> parent(count, count);
    visit_matches(document.json, "/nodes/*/children/*", "", [&](const Json& child, const std::string& place) {
        const std::size_t owner = std::stoul(place.substr(std::string_view("/nodes/").size()));
        if (parent[child] != count)
            document.fault(place, "node " + child.dump() + " has a second parent here");
        parent[child] = owner;
    });
    for (std::size_t node = 0; node < count; ++node) {
        std::size_t up = node;
        for (std::size_t steps = 0; parent[up] != count; ++steps) {
            up = parent[up];
            if (up == node || steps > count) {
                document.fault("/nodes/" + std::to_string(node), "is its own ancestor");
            }
        }
    }
    visit_matches(document.json, "/scenes/*/nodes/*", "", [&](const Json& root, const std::string& place) {
        if (parent[root] != count) document.fault(place, "node " + root.dump() + " is a child, not a root");
    });
}

}  // namespace

void check_references(const GltfDocument& document) {
    check_shapes(document);
    const auto check = [&](const Json& value, const std::string& place, std::size_t count,
                           const std::string& target) {
        if (!value.is_number_unsigned()) document.fault(place, "must be an index, not " + value.dump());
        if (value.get<std::uint64_t>() >= count) {
            document.fault(place, "points at element " + value.dump() + " of " + target + ", which has " +
                                      std::to_string(count));
        }
    };
    for (const Reference& reference : references) {
        const std::size_t count = length(document.json, reference.target);
        visit_matches(document.json, reference.place, "", [&](const Json& value, const std::string& place) {
            check(value, place, count, std::string(reference.target));
        });
    }
    visit_matches(document.json, "/animations/*", "",
                  [&](const Json& animation, const std::string& animation_place) {
                      visit_matches(animation, "/channels/*/sampler", animation_place,
                                    [&](const Json& value, const std::string& place) {
                                        check(value, place, length(animation, "/samplers"),
                                              animation_place + "/samplers");
                                    });
                  });
    check_tree(document);
}

}  // namespace foveray::scene
