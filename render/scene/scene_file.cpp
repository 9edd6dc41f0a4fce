#include "render/scene/scene_file.h"

#include <cmath>
#include <map>
#include <memory>

#include "base/error.h"
#include "base/json.h"
#include "render/scene/gltf_loader.h"
#include "render/scene/scene_builder.h"

namespace foveray::scene {
namespace {

/// Reads one scene file whose JSON the schema has accepted, so shapes and required keys are certain.
class SceneFileReader {
  public:
    SceneFileReader(std::filesystem::path file, Json json) : file_(std::move(file)), json_(std::move(json)) {}

    Scene read();

  private:
    [[noreturn]] void fault(const std::string& place, const std::string& what,
                            const std::string& remedy) const {
        throw_bad_input(file_.string() + ": " + place, what, remedy);
    }
    float number(const Json& object, const char* key, const std::string& place, float otherwise) const;
    vec2 pair(const Json& object, const char* key, const std::string& place) const;
    vec3 triple(const Json& object, const char* key, const std::string& place, vec3 otherwise) const;
    vec3 unit(const Json& object, const char* key, const std::string& place) const;
    quat rotation(const Json& object, const char* key, const std::string& place) const;
    Pose pose(const Json& object, const std::string& place) const;
    Transform transform(const Json& owner, const std::string& owner_place) const;
    std::filesystem::path path(const Json& object) const {
        return file_.parent_path() / object["file"].get<std::string>();
    }

    void add_model(const Json& model, const std::string& place);
    void add_light(const Json& light, const std::string& place);
    void add_area_light(const Json& light, vec3 radiance, const std::string& place);
    void add_camera(const Json& camera);
    void add_real_surface(const Json& surface, const std::string& place);
    void set_environment(const Json& environment);

    std::filesystem::path file_;
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
    each("lights", [&](const Json& l, const std::string& place) { add_light(l, place); });
    each("real_surfaces", [&](const Json& s, const std::string& place) { add_real_surface(s, place); });
    if (json_.contains("environment")) set_environment(json_["environment"]);
    if (json_.contains("world_from_stage")) {
        builder_.set_world_from_stage(pose(json_["world_from_stage"], "/world_from_stage"));
    }
    if (json_.contains("camera")) add_camera(json_["camera"]);
    return std::move(builder_).build();
}

float SceneFileReader::number(const Json& object, const char* key, const std::string& place,
                              float otherwise) const {
    const float value = object.value(key, otherwise);
    if (!std::isfinite(value)) fault(place + "/" + key, "is too large a number", "correct it");
    return value;
}

vec2 SceneFileReader::pair(const Json& object, const char* key, const std::string& place) const {
    const Json& list = object[key];
    const vec2 v(list[0].get<float>(), list[1].get<float>());
    if (!std::isfinite(v.x + v.y)) fault(place + "/" + key, "holds too large a number", "correct it");
    return v;
}

vec3 SceneFileReader::triple(const Json& object, const char* key, const std::string& place,
                             vec3 otherwise) const {
    if (!object.contains(key)) return otherwise;
    const Json& list = object[key];
    const vec3 v(list[0].get<float>(), list[1].get<float>(), list[2].get<float>());
    if (!std::isfinite(v.x + v.y + v.z)) fault(place + "/" + key, "holds too large a number", "correct it");
    return v;
}

vec3 SceneFileReader::unit(const Json& object, const char* key, const std::string& place) const {
    const vec3 v = triple(object, key, place, vec3(0.0f));
    if (!(glm::length(v) > 1e-6f))
        fault(place + "/" + key, "is no direction: it has no length", "correct it");
    return glm::normalize(v);
}

quat SceneFileReader::rotation(const Json& object, const char* key, const std::string& place) const {
    if (!object.contains(key)) return {1.0f, 0.0f, 0.0f, 0.0f};
    const Json& q = object[key];
    const quat value(q[3].get<float>(), q[0].get<float>(), q[1].get<float>(), q[2].get<float>());
    const float length = glm::length(value);
    if (!(length > 1e-6f && std::isfinite(length))) {
        fault(place + "/" + key, "is no rotation", "give a quaternion x, y, z, w");
    }
    return glm::normalize(value);
}

Pose SceneFileReader::pose(const Json& object, const std::string& place) const {
    return {rotation(object, "orientation", place), triple(object, "position", place, vec3(0.0f))};
}

Transform SceneFileReader::transform(const Json& owner, const std::string& owner_place) const {
    if (!owner.contains("transform")) return {};
    const Json& json = owner["transform"];
    const std::string place = owner_place + "/transform";
    Transform t;
    t.translation = triple(json, "translation", place, vec3(0.0f));
    t.scale = triple(json, "scale", place, vec3(1.0f));
    t.rotation = rotation(json, "rotation", place);
    if (json.contains("euler_degrees")) {
        if (json.contains("rotation"))
            fault(place, "gives the rotation twice", "keep rotation or euler_degrees");
        const vec3 e = glm::radians(triple(json, "euler_degrees", place, vec3(0.0f)));
        t.rotation = glm::angleAxis(e.y, vec3(0, 1, 0)) * glm::angleAxis(e.x, vec3(1, 0, 0)) *
                     glm::angleAxis(e.z, vec3(0, 0, 1));
    }
    return t;
}

void SceneFileReader::add_model(const Json& model, const std::string& place) {
    const std::filesystem::path file = path(model).lexically_normal();
    std::unique_ptr<GltfModel>& gltf = models_[file];
    if (!gltf) gltf = std::make_unique<GltfModel>(builder_, file);

    Node root;
    root.name = model.value("name", file.stem().string());
    root.local = transform(model, place);
    GltfModel::Use use;
    use.parent = builder_.add(std::move(root));
    if (model.contains("scene")) use.scene = model["scene"].get<std::uint32_t>();
    use.animate = model.value("animate", true);
    gltf->instantiate(use);
}

void SceneFileReader::add_light(const Json& json, const std::string& place) {
    const std::string type = json["type"];
    const vec3 emitted = triple(json, "color", place, vec3(1.0f)) * number(json, "intensity", place, 1.0f);
    if (type == "area") return add_area_light(json, emitted, place);

    Light light;
    light.name = json.value("name", type);
    light.kind = type == "directional" ? LightKind::Directional
                 : type == "point"     ? LightKind::Point
                                       : LightKind::Spot;
    light.intensity = emitted;
    light.range = number(json, "range", place, 0.0f);
    light.inner_cone = radians(number(json, "inner_cone_degrees", place, 0.0f));
    light.outer_cone = radians(number(json, "outer_cone_degrees", place, 45.0f));
    if (!(light.inner_cone < light.outer_cone)) {
        fault(place, "has an inner cone that is not inside the outer one", "correct inner_cone_degrees");
    }
    Node node;
    node.name = light.name;
    node.local.translation = triple(json, "position", place, vec3(0.0f));
    if (json.contains("direction")) node.local.rotation = looking_along(unit(json, "direction", place));
    node.light = builder_.add(std::move(light));
    builder_.add(std::move(node));
}

void SceneFileReader::add_area_light(const Json& json, vec3 radiance, const std::string& place) {
    const vec3 u = triple(json, "half_u", place, vec3(0.0f)), v = triple(json, "half_v", place, vec3(0.0f));
    const vec3 normal = glm::cross(u, v);
    if (!(glm::length(normal) > 1e-12f)) fault(place, "has no area", "correct half_u and half_v");
    Node node;
    node.name = json.value("name", "area");
    node.matrix = mat4(vec4(u, 0.0f), vec4(-v, 0.0f), vec4(-glm::normalize(normal), 0.0f),
                       vec4(triple(json, "center", place, vec3(0.0f)), 1.0f));
    node.area_light = builder_.add(AreaLight{node.name, vec2(1.0f), radiance});
    builder_.add(std::move(node));
}

void SceneFileReader::add_camera(const Json& json) {
    const std::string place = "/camera";
    Node node;
    node.name = "camera";
    node.local.translation = triple(json, "position", place, vec3(0.0f));
    const vec3 direction = triple(json, "look_at", place, vec3(0.0f)) - node.local.translation;
    if (!(glm::length(direction) > 1e-6f)) fault(place, "looks at itself", "move position or look_at");
    node.local.rotation = looking_along(direction);
    node.camera =
        builder_.add(Camera{"camera", radians(number(json, "vertical_fov_degrees", place, 50.0f)), 0.0f});
    builder_.add(std::move(node));
}

void SceneFileReader::add_real_surface(const Json& json, const std::string& place) {
    const std::string type = json["type"];
    RealSurface surface;
    surface.name = json.value("name", type);
    surface.albedo = triple(json, "albedo", place, surface.albedo);
    surface.reflectance = number(json, "reflectance", place, surface.reflectance);
    surface.roughness = number(json, "roughness", place, surface.roughness);
    if (type == "plane") {
        const vec3 normal = unit(json, "normal", place);
        const vec3 fallback = std::abs(normal.x) > 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0);
        const vec3 wished = json.contains("u_axis") ? unit(json, "u_axis", place) : fallback;
        const vec3 u = wished - normal * glm::dot(wished, normal);
        if (!(glm::length(u) > 1e-3f))
            fault(place + "/u_axis", "is parallel to the normal", "give another axis");
        const vec3 axis = glm::normalize(u);
        surface.stage_from_object =
            mat4(vec4(axis, 0.0f), vec4(normal, 0.0f), vec4(glm::cross(axis, normal), 0.0f),
                 vec4(triple(json, "center", place, vec3(0.0f)), 1.0f));
        surface.mesh = builder_.add(make_rectangle(pair(json, "half_size", place)));
    } else if (type == "box") {
        surface.stage_from_object = foveray::to_matrix(pose(json["pose"], place + "/pose"));
        surface.mesh = builder_.add(make_box(triple(json, "half_size", place, vec3(1.0f))));
    } else {
        SceneBuilder only_this;
        GltfModel(only_this, path(json)).instantiate({});
        Mesh mesh = flatten(std::move(only_this).build());
        if (mesh.primitives.empty())
            fault(place + "/file", path(json).string() + " has no triangles", "take another");
        surface.stage_from_object = to_matrix(transform(json, place));
        surface.mesh = builder_.add(std::move(mesh));
    }
    builder_.add(std::move(surface));
}

void SceneFileReader::set_environment(const Json& json) {
    const std::string place = "/environment";
    Environment environment = default_sky();
    if (json.contains("file")) {
        if (json.contains("color")) fault(place, "has a file and a color", "keep one of them");
        environment.radiance = read_hdr(path(json));
    } else if (json.contains("color")) {
        environment = constant_environment(triple(json, "color", place, vec3(0.0f)));
    }
    environment.intensity = number(json, "intensity", place, 1.0f);
    environment.rotation = radians(number(json, "rotation_degrees", place, 0.0f));
    builder_.set(std::move(environment));
}

}  // namespace

Scene load_scene_file(const std::filesystem::path& file) {
    Json json = read_json(file);
    check_json(json, scene_schema(), file);
    return SceneFileReader(file, std::move(json)).read();
}

}  // namespace foveray::scene
