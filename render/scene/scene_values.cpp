#include "render/scene/scene_values.h"

#include <cmath>

namespace foveray::scene {

float SceneValues::number(const Json& object, const char* key, const std::string& place,
                          float otherwise) const {
    const float value = object.value(key, otherwise);
    if (!std::isfinite(value)) fault(place + "/" + key, "is too large a number", "correct it");
    return value;
}

vec2 SceneValues::pair(const Json& object, const char* key, const std::string& place) const {
    const Json& list = object[key];
    const vec2 v(list[0].get<float>(), list[1].get<float>());
    if (!std::isfinite(v.x + v.y)) fault(place + "/" + key, "holds too large a number", "correct it");
    return v;
}

vec3 SceneValues::triple(const Json& object, const char* key, const std::string& place,
                         vec3 otherwise) const {
    if (!object.contains(key)) return otherwise;
    const Json& list = object[key];
    const vec3 v(list[0].get<float>(), list[1].get<float>(), list[2].get<float>());
    if (!std::isfinite(v.x + v.y + v.z)) fault(place + "/" + key, "holds too large a number", "correct it");
    return v;
}

vec3 SceneValues::unit(const Json& object, const char* key, const std::string& place) const {
    const vec3 v = triple(object, key, place, vec3(0.0f));
    if (!(glm::length(v) > 1e-6f))
        fault(place + "/" + key, "is no direction: it has no length", "correct it");
    return glm::normalize(v);
}

quat SceneValues::rotation(const Json& object, const char* key, const std::string& place) const {
    if (!object.contains(key)) return {1.0f, 0.0f, 0.0f, 0.0f};
    const Json& q = object[key];
    const quat value(q[3].get<float>(), q[0].get<float>(), q[1].get<float>(), q[2].get<float>());
    const float length = glm::length(value);
    if (!(length > 1e-6f && std::isfinite(length))) {
        fault(place + "/" + key, "is no rotation", "give a quaternion x, y, z, w");
    }
    return glm::normalize(value);
}

Pose SceneValues::pose(const Json& object, const std::string& place) const {
    return {rotation(object, "orientation", place), triple(object, "position", place, vec3(0.0f))};
}

Transform SceneValues::transform(const Json& json, const std::string& place) const {
    Transform t;
    t.translation = triple(json, "translation", place, vec3(0.0f));
    t.scale = triple(json, "scale", place, vec3(1.0f));
    if (glm::any(glm::lessThan(t.scale, vec3(1e-12f))) || glm::any(glm::greaterThan(t.scale, vec3(1e12f)))) {
        fault(place + "/scale", "is out of range", "give 1e-12 to 1e12");
    }
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

}  // namespace foveray::scene
