#include "render/scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "base/error.h"
#include "base/json.h"
#include "render/scene/gltf_loader.h"
#include "render/scene/scene_animation.h"
#include "render/scene/scene_builder.h"
#include "render/scene/scene_objects.h"
#include "render/scene/scene_probes.h"
#include "render/scene/scene_values.h"

namespace foveray::scene {
namespace {

/// Reads one scene file whose JSON the schema has accepted, so shapes and required keys are certain.
class SceneFileReader {
  public:
    SceneFileReader(std::filesystem::path file, Json json, std::vector<std::filesystem::path>* files)
        : values_(std::move(file)), json_(std::move(json)), builder_(files) {}

    Scene read();

  private:
    Transform transform_of(const Json& owner, const std::string& place) const {
        return owner.contains("transform") ? values_.transform(owner["transform"], place + "/transform")
                                           : Transform{};
    }

    void add_model(const Json& model, const std::string& place);
    void add_light(const Json& light, const std::string& place);
    void add_area_light(const Json& light, vec3 radiance, const std::string& place);
    /// The node that an animated light hangs from; empty for one that stands still.
    std::optional<NodeId> mover(const Json& light, const std::string& place);
    void add_camera(const Json& camera);
    void add_real_surface(const Json& surface, const std::string& place);
    void set_environment(const Json& environment);

    SceneValues values_;
    Json json_;
    SceneBuilder builder_;
    std::map<std::filesystem::path, std::unique_ptr<GltfModel>> models_;
};

/// The rotation that takes -z to `direction`, with y up as far as possible.
quat looking_along(vec3 direction) {
    const vec3 z = -glm::normalize(direction);
    const vec3 up = std::abs(z.y) > 0.999f ? vec3(0, 0, 1) : vec3(0, 1, 0);
    const vec3 x = glm::normalize(glm::cross(up, z));
    return glm::quat_cast(mat3(x, glm::cross(z, x), z));
}

Scene SceneFileReader::read() {
    const auto each = [&](const std::string& key, const auto& act) {
        const Json list = json_.value(key, Json::array());
        for (std::size_t i = 0; i < list.size(); ++i) act(list[i], "/" + key + "/" + std::to_string(i));
    };
    each("models", [&](const Json& m, const std::string& place) { add_model(m, place); });
    each("objects",
         [&](const Json& o, const std::string& place) { add_object(builder_, values_, o, place); });
    each("lights", [&](const Json& l, const std::string& place) { add_light(l, place); });
    each("real_surfaces", [&](const Json& s, const std::string& place) { add_real_surface(s, place); });
    if (json_.contains("probes")) add_probes(builder_, values_, json_["probes"]);
    if (json_.contains("environment")) set_environment(json_["environment"]);
    if (json_.contains("world_from_stage")) {
        builder_.set_world_from_stage(values_.pose(json_["world_from_stage"], "/world_from_stage"));
    }
    if (json_.contains("camera")) add_camera(json_["camera"]);
    return std::move(builder_).build();
}

void SceneFileReader::add_model(const Json& model, const std::string& place) {
    const std::filesystem::path file = values_.path(model["file"]).lexically_normal();
    std::unique_ptr<GltfModel>& gltf = models_[file];
    if (!gltf) gltf = std::make_unique<GltfModel>(builder_, file);

    Node root;
    root.name = model.value("name", file.stem().string());
    root.local = transform_of(model, place);
    root.present = read_presence(values_, model, place);
    GltfModel::Use use;
    use.parent = builder_.add(std::move(root));
    if (model.contains("scene")) use.scene = model["scene"].get<std::uint32_t>();
    use.animate = model.value("animate", true);
    gltf->instantiate(use);
}

void SceneFileReader::add_light(const Json& json, const std::string& place) {
    const std::string type = json["type"];
    const vec3 emitted =
        values_.triple(json, "color", place, vec3(1.0f)) * values_.number(json, "intensity", place, 1.0f);
    if (type == "area") return add_area_light(json, emitted, place);

    Light light;
    light.name = json.value("name", type);
    light.kind = type == "directional" ? LightKind::Directional
                 : type == "point"     ? LightKind::Point
                                       : LightKind::Spot;
    light.intensity = emitted;
    light.range = values_.number(json, "range", place, 0.0f);
    light.inner_cone = radians(values_.number(json, "inner_cone_degrees", place, 0.0f));
    light.outer_cone = radians(values_.number(json, "outer_cone_degrees", place, 45.0f));
    if (!(light.inner_cone < light.outer_cone)) {
        values_.fault(place, "has an inner cone that is not inside the outer one",
                      "correct inner_cone_degrees");
    }
    Node node;
    node.name = light.name;
    node.parent = mover(json, place);
    node.present = read_presence(values_, json, place);
    node.local.translation = values_.triple(json, "position", place, vec3(0.0f));
    if (json.contains("direction"))
        node.local.rotation = looking_along(values_.unit(json, "direction", place));
    node.light = builder_.add(std::move(light));
    builder_.add(std::move(node));
}

std::optional<NodeId> SceneFileReader::mover(const Json& light, const std::string& place) {
    if (!light.contains("animation")) return std::nullopt;
    Node node;
    node.name = "mover";
    const NodeId id = builder_.add(std::move(node));
    add_animation(builder_, values_, light, place, id, {});
    return id;
}

void SceneFileReader::add_area_light(const Json& json, vec3 radiance, const std::string& place) {
    const std::string shape = json.value("shape", "rectangle");
    const vec3 center = values_.triple(json, "center", place, vec3(0.0f));
    Node node;
    node.name = json.value("name", "area");
    node.parent = mover(json, place);
    node.present = read_presence(values_, json, place);
    AreaLight light{node.name, AreaLightShape::Rectangle, vec3(1.0f), radiance};
    if (shape == "rectangle") {
        const vec3 u = values_.triple(json, "half_u", place, vec3(0.0f)),
                   v = values_.triple(json, "half_v", place, vec3(0.0f));
        const vec3 normal = glm::cross(u, v);
        if (!(glm::length(normal) > 1e-12f)) values_.fault(place, "has no area", "correct half_u and half_v");
        node.matrix =
            mat4(vec4(u, 0.0f), vec4(-v, 0.0f), vec4(-glm::normalize(normal), 0.0f), vec4(center, 1.0f));
    } else if (shape == "box") {
        light.shape = AreaLightShape::Box;
        light.half_size = values_.triple(json, "half_size", place, vec3(0.5f));
        node.local.translation = center;
        if (json.contains("rotation")) node.local.rotation = values_.rotation(json, "rotation", place);
    } else {
        light.shape = AreaLightShape::Sphere;
        light.half_size = vec3(values_.number(json, "radius", place, 0.1f));
        node.local.translation = center;
    }
    node.area_light = builder_.add(std::move(light));
    builder_.add(std::move(node));
}

void SceneFileReader::add_camera(const Json& json) {
    const std::string place = "/camera";
    Node node;
    node.name = "camera";
    node.local.translation = values_.triple(json, "position", place, vec3(0.0f));
    const vec3 direction = values_.triple(json, "look_at", place, vec3(0.0f)) - node.local.translation;
    if (!(glm::length(direction) > 1e-6f))
        values_.fault(place, "looks at itself", "move position or look_at");
    node.local.rotation = looking_along(direction);
    node.camera = builder_.add(
        Camera{"camera", radians(values_.number(json, "vertical_fov_degrees", place, 50.0f)), 0.0f});
    builder_.add(std::move(node));
}

void SceneFileReader::add_real_surface(const Json& json, const std::string& place) {
    const std::string type = json["type"];
    RealSurface surface;
    surface.name = json.value("name", type);
    surface.albedo = values_.triple(json, "albedo", place, surface.albedo);
    surface.reflectance = values_.number(json, "reflectance", place, surface.reflectance);
    surface.roughness = values_.number(json, "roughness", place, surface.roughness);
    if (type == "plane") {
        const vec3 normal = values_.unit(json, "normal", place);
        const vec3 fallback = std::abs(normal.x) > 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0);
        const vec3 wished = json.contains("u_axis") ? values_.unit(json, "u_axis", place) : fallback;
        const vec3 u = wished - normal * glm::dot(wished, normal);
        if (!(glm::length(u) > 1e-3f))
            values_.fault(place + "/u_axis", "is parallel to the normal", "give another axis");
        const vec3 axis = glm::normalize(u);
        surface.stage_from_object =
            mat4(vec4(axis, 0.0f), vec4(normal, 0.0f), vec4(glm::cross(axis, normal), 0.0f),
                 vec4(values_.triple(json, "center", place, vec3(0.0f)), 1.0f));
        surface.mesh = builder_.add(make_rectangle(values_.pair(json, "half_size", place)));
    } else if (type == "box") {
        surface.stage_from_object = foveray::to_matrix(values_.pose(json["pose"], place + "/pose"));
        surface.mesh = builder_.add(make_box(values_.triple(json, "half_size", place, vec3(1.0f))));
    } else {
        SceneBuilder only_this(builder_.files());
        GltfModel(only_this, values_.path(json["file"])).instantiate({});
        Mesh mesh = flatten(std::move(only_this).build());
        if (mesh.primitives.empty())
            values_.fault(place + "/file", values_.path(json["file"]).string() + " has no triangles",
                          "take another");
        surface.stage_from_object = to_matrix(transform_of(json, place));
        surface.mesh = builder_.add(std::move(mesh));
    }
    builder_.add(std::move(surface));
}

void SceneFileReader::set_environment(const Json& json) {
    const std::string place = "/environment";
    Environment environment = default_sky();
    if (json.contains("file")) {
        if (json.contains("color")) values_.fault(place, "has a file and a color", "keep one of them");
        builder_.note_file(values_.path(json["file"]));
        environment.radiance = read_hdr(values_.path(json["file"]));
    } else if (json.contains("color")) {
        environment = constant_environment(values_.triple(json, "color", place, vec3(0.0f)));
    }
    environment.intensity = values_.number(json, "intensity", place, 1.0f);
    environment.rotation = radians(values_.number(json, "rotation_degrees", place, 0.0f));
    builder_.set(std::move(environment));
}

constexpr int deepest_json = 64;  // levels: the schema's check of solids is recursive

bool is_deeper(const Json& json, int levels) {
    return levels == 0 || (json.is_structured() && std::ranges::any_of(json, [&](const Json& inner) {
                               return is_deeper(inner, levels - 1);
                           }));
}

}  // namespace

Scene load_scene_file(const std::filesystem::path& file, std::vector<std::filesystem::path>* files) {
    if (files) files->push_back(file);
    Json json = read_json(file);
    if (is_deeper(json, deepest_json)) {
        throw_bad_input(file.string(), "it is nested too deeply", "flatten its solids");
    }
    check_json(json, scene_schema(), file);
    return SceneFileReader(file, std::move(json), files).read();
}

}  // namespace foveray::scene
