#include "render/scene/gltf_loader.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "render/scene/gltf_animations.h"
#include "render/scene/gltf_materials.h"
#include "render/scene/gltf_meshes.h"
#include "render/scene/gltf_values.h"
#include "render/scene/singular.h"

namespace foveray::scene {
namespace {

std::string node_place(int node) { return "/nodes/" + std::to_string(node); }

vec3 to_vec3(const std::vector<float>& v) { return {v[0], v[1], v[2]}; }

quat to_rotation(const GltfDocument& document, const std::vector<float>& xyzw, const std::string& place) {
    const quat q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    if (!(glm::length(q) > 1e-6f)) document.fault(place, "is no rotation: the quaternion is zero");
    return glm::normalize(q);
}

void read_transform(Node& node, const GltfDocument& document, const tinygltf::Node& parsed,
                    const std::string& place) {
    if (!parsed.matrix.empty()) {
        const auto m = finite_floats(document, parsed.matrix, 16, place + "/matrix");
        mat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
        node.matrix = matrix;
        return;
    }
    if (!parsed.translation.empty()) {
        node.local.translation =
            to_vec3(finite_floats(document, parsed.translation, 3, place + "/translation"));
    }
    if (!parsed.rotation.empty()) {
        const std::string here = place + "/rotation";
        node.local.rotation = to_rotation(document, finite_floats(document, parsed.rotation, 4, here), here);
    }
    if (!parsed.scale.empty()) {
        node.local.scale = to_vec3(finite_floats(document, parsed.scale, 3, place + "/scale"));
    }
}

std::vector<Transform> read_instancing(const GltfDocument& document, const Json& extension,
                                       const std::string& place) {
    std::vector<Transform> out;
    bool first = true;
    const Json attributes = extension.value("attributes", Json::object());
    const auto each = [&](const std::string& name, std::uint32_t width, const auto& assign) {
        if (!attributes.contains(name)) return;
        const std::string here = place + "/attributes/" + name;
        const auto values = read_floats(document, attributes[name].get<int>(), width, here);
        const std::size_t count = values.size() / width;
        if (!first && count != out.size()) document.fault(here, "must be as long as the other attributes");
        first = false;
        out.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto at = values.begin() + static_cast<std::ptrdiff_t>(i * width);
            assign(out[i], std::vector<float>(at, at + width), here);
        }
    };
    each("TRANSLATION", 3, [](Transform& t, const auto& v, const auto&) { t.translation = to_vec3(v); });
    each("ROTATION", 4, [&](Transform& t, const auto& v, const std::string& here) {
        t.rotation = to_rotation(document, v, here);
    });
    each("SCALE", 3, [](Transform& t, const auto& v, const auto&) { t.scale = to_vec3(v); });
    return out;
}

std::optional<LightId> add_light(SceneBuilder& builder, const GltfDocument& document, std::size_t index) {
    const std::string place = "/extensions/KHR_lights_punctual/lights/" + std::to_string(index);
    const tinygltf::Light& parsed = document.model.lights[index];
    Light light;
    light.name = parsed.name;
    if (parsed.type == "directional") {
        light.kind = LightKind::Directional;
    } else if (parsed.type == "point") {
        light.kind = LightKind::Point;
    } else if (parsed.type == "spot") {
        light.kind = LightKind::Spot;
        light.inner_cone = static_cast<float>(parsed.spot.innerConeAngle);
        light.outer_cone = static_cast<float>(parsed.spot.outerConeAngle);
        if (!(light.inner_cone >= 0.0f && light.inner_cone < light.outer_cone &&
              light.outer_cone <= pi / 2 + 1e-4f)) {
            document.fault(place + "/spot", "needs 0 <= innerConeAngle < outerConeAngle <= pi / 2");
        }
    } else {
        document.fault(place + "/type", "must be directional, point or spot");
    }
    vec3 color(1.0f);
    if (!parsed.color.empty()) color = to_vec3(finite_floats(document, parsed.color, 3, place + "/color"));
    light.intensity = color * finite_floats(document, {parsed.intensity}, 1, place + "/intensity")[0];
    light.range = finite_floats(document, {parsed.range}, 1, place + "/range")[0];
    return builder.add(std::move(light));
}

std::optional<CameraId> add_camera(SceneBuilder& builder, const GltfDocument& document, std::size_t index) {
    const tinygltf::Camera& parsed = document.model.cameras[index];
    const std::string place = "/cameras/" + std::to_string(index);
    if (parsed.type != "perspective") {
        builder.warn(document.file.string() + ": " + place + ": orthographic cameras are left out");
        return std::nullopt;
    }
    Camera camera;
    camera.name = parsed.name;
    camera.vertical_fov = static_cast<float>(parsed.perspective.yfov);
    camera.aspect_ratio = static_cast<float>(parsed.perspective.aspectRatio);
    if (!(camera.vertical_fov > 0.0f && camera.vertical_fov < pi)) {
        document.fault(place + "/perspective/yfov", "must be between 0 and pi");
    }
    return builder.add(std::move(camera));
}

/// Highest joint number that the mesh uses, plus one.
std::size_t joints_used(const Mesh& mesh) {
    std::size_t used = 0;
    for (const Primitive& p : mesh.primitives) {
        for (const glm::u16vec4 j : p.joints) {
            for (int k = 0; k < 4; ++k) used = std::max<std::size_t>(used, j[k] + 1u);
        }
    }
    return used;
}

}  // namespace

struct GltfModel::Impl {
    SceneBuilder& builder;
    GltfDocument document;
    std::vector<MaterialId> materials;
    std::vector<std::optional<MeshId>> meshes;

    int scene_index(const Use& use) const;
    std::map<int, NodeId> add_nodes(const Use& use);
    NodeId add_node(int index, std::optional<NodeId> parent);
    void add_skins(const std::map<int, NodeId>& nodes);
    void warn_of_flat(const std::map<int, NodeId>& nodes) const;
    Skin read_skin(std::size_t index, const std::map<int, NodeId>& nodes) const;
};

namespace {

GltfDocument read_noted(SceneBuilder& builder, const std::filesystem::path& file) {
    builder.note_file(file);
    GltfDocument document = read_gltf(file);
    for (const char* kind : {"buffers", "images"}) {
        if (!document.json.contains(kind)) continue;
        for (const Json& part : document.json[kind]) {
            const std::string uri = part.value("uri", "");
            if (!uri.empty() && !uri.starts_with("data:")) builder.note_file(path_of(document, uri));
        }
    }
    return document;
}

}  // namespace

GltfModel::GltfModel(SceneBuilder& builder, const std::filesystem::path& file)
    : impl_(std::make_unique<Impl>(builder, read_noted(builder, file))) {
    const GltfDocument& document = impl_->document;
    std::string ignored;
    for (const std::string& name : document.ignored_extensions)
        ignored += (ignored.empty() ? "" : ", ") + name;
    if (!ignored.empty())
        builder.warn(file.string() + ": drawn without what foveray does not support: " + ignored);
    try {
        impl_->materials = add_materials(builder, document);
        impl_->meshes = add_meshes(builder, document, impl_->materials);
    } catch (const Json::exception& e) {  // a value of another type than glTF has there
        document.fault("/", e.what());
    }
}

GltfModel::~GltfModel() = default;

void GltfModel::instantiate(const Use& use) {
    try {
        const std::map<int, NodeId> nodes = impl_->add_nodes(use);
        impl_->add_skins(nodes);
        if (use.animate) add_animations(impl_->builder, impl_->document, nodes);
        impl_->warn_of_flat(nodes);
    } catch (const Json::exception& e) {
        impl_->document.fault("/", e.what());
    }
}

int GltfModel::Impl::scene_index(const Use& use) const {
    const std::size_t count = document.model.scenes.size();
    if (count == 0) document.fault("/scenes", "is missing, so there is nothing to show");
    const std::size_t index =
        use.scene.value_or(static_cast<std::uint32_t>(std::max(document.model.defaultScene, 0)));
    if (index >= count) {
        document.fault(
            "/scenes",
            "scene " + std::to_string(index) + " is asked for, but there are " + std::to_string(count),
            "ask for another scene");
    }
    return static_cast<int>(index);
}

std::map<int, NodeId> GltfModel::Impl::add_nodes(const Use& use) {
    struct Pending {
        int node;
        std::optional<NodeId> parent;
    };
    std::map<int, NodeId> ids;
    std::vector<Pending> stack;
    const auto push = [&](const std::vector<int>& nodes, std::optional<NodeId> parent) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) stack.push_back({*node, parent});
    };
    push(document.model.scenes[static_cast<std::size_t>(scene_index(use))].nodes, use.parent);
    while (!stack.empty()) {  // depth first, parents before children
        const Pending next = stack.back();
        stack.pop_back();
        const NodeId id = add_node(next.node, next.parent);
        ids[next.node] = id;
        push(document.model.nodes[static_cast<std::size_t>(next.node)].children, id);
    }
    return ids;
}

NodeId GltfModel::Impl::add_node(int index, std::optional<NodeId> parent) {
    const auto at = static_cast<std::size_t>(index);
    const tinygltf::Node& parsed = document.model.nodes[at];
    const Json& json = document.json["nodes"][at];
    const std::string place = node_place(index);
    Node node;
    node.name = parsed.name;
    node.parent = parent;
    read_transform(node, document, parsed, place);
    if (parsed.mesh >= 0) node.mesh = meshes[static_cast<std::size_t>(parsed.mesh)];
    if (node.mesh && !parsed.weights.empty()) {
        const std::size_t targets = builder.so_far().meshes[*node.mesh].morph_weights.size();
        node.morph_weights = finite_floats(document, parsed.weights, targets, place + "/weights");
    }
    if (const Json* light = extension_of(json, "KHR_lights_punctual"); light && light->contains("light")) {
        node.light = add_light(builder, document, (*light)["light"].get<std::size_t>());
    }
    if (parsed.camera >= 0)
        node.camera = add_camera(builder, document, static_cast<std::size_t>(parsed.camera));
    const std::string instancing = "EXT_mesh_gpu_instancing";
    if (const Json* extension = extension_of(json, instancing); extension && node.mesh) {
        node.mesh_instances = read_instancing(document, *extension, place + "/extensions/" + instancing);
    }
    return builder.add(std::move(node));
}

void GltfModel::Impl::add_skins(const std::map<int, NodeId>& nodes) {
    std::map<int, SkinId> skins;
    for (const auto& [index, id] : nodes) {
        const int skin = document.model.nodes[static_cast<std::size_t>(index)].skin;
        const std::optional<MeshId> mesh = builder.so_far().nodes[id].mesh;
        const std::size_t used = mesh ? joints_used(builder.so_far().meshes[*mesh]) : 0;
        if (skin < 0 || used == 0) continue;
        if (!skins.contains(skin))
            skins[skin] = builder.add(read_skin(static_cast<std::size_t>(skin), nodes));
        const std::size_t joints = builder.so_far().skins[skins[skin]].joints.size();
        if (used > joints) {
            document.fault(node_place(index) + "/skin", "has " + std::to_string(joints) +
                                                            " joints, but the mesh uses joint " +
                                                            std::to_string(used - 1));
        }
        builder.set_skin(id, skins[skin]);
    }
}

/// A mesh that a scale of 0 flattens for good is not drawn; those of skins are placed by their joints.
void GltfModel::Impl::warn_of_flat(const std::map<int, NodeId>& nodes) const {
    for (const auto& [index, id] : nodes) {
        const Node& node = builder.so_far().nodes[id];
        if (!node.mesh || node.skin) continue;
        const std::optional<NodeId> flat = flattened_by(builder.so_far(), id);
        if (!flat) continue;
        const auto at = std::ranges::find(nodes, *flat, [](const auto& pair) { return pair.second; });
        const std::string cause = at == nodes.end()    ? "its parents'"
                                  : at->first == index ? "its"
                                                       : node_place(at->first) + "'s";
        builder.warn(document.file.string() + ": " + node_place(index) + ": its mesh is left out: " + cause +
                     " transform flattens it (a scale of 0)");
    }
}

Skin GltfModel::Impl::read_skin(std::size_t index, const std::map<int, NodeId>& nodes) const {
    const tinygltf::Skin& parsed = document.model.skins[index];
    const std::string place = "/skins/" + std::to_string(index);
    Skin skin;
    skin.name = parsed.name;
    for (std::size_t j = 0; j < parsed.joints.size(); ++j) {
        const auto node = nodes.find(parsed.joints[j]);
        if (node == nodes.end())
            document.fault(place + "/joints/" + std::to_string(j), "is not in the scene");
        skin.joints.push_back(node->second);
    }
    skin.inverse_bind.assign(skin.joints.size(), mat4(1.0f));
    if (parsed.inverseBindMatrices >= 0) {
        const std::string here = place + "/inverseBindMatrices";
        const auto values = read_floats(document, parsed.inverseBindMatrices, 16, here);
        if (values.size() < 16 * skin.joints.size())
            document.fault(here, "must have a matrix for each joint");
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            for (int i = 0; i < 16; ++i) {
                skin.inverse_bind[j][i / 4][i % 4] = values[16 * j + static_cast<std::size_t>(i)];
            }
        }
    }
    return skin;
}

}  // namespace foveray::scene
