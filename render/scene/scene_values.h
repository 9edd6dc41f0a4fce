#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/json.h"
#include "render/scene/node.h"

namespace foveray::scene {

/// Reads the values of a scene file that the schema has accepted, so that their JSON types are certain.
/// `place` is the JSON pointer of `object`. Numbers too large for a float, directions without length and the
/// like throw Fault(BadInput) with file and place.
class SceneValues {
  public:
    explicit SceneValues(std::filesystem::path file) : file_(std::move(file)) {}

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
    /// The object itself is the transform.
    Transform transform(const Json& object, const std::string& place) const;
    /// Of a file that is named relative to the scene file.
    std::filesystem::path path(const Json& name) const {
        return file_.parent_path() / name.get<std::string>();
    }

  private:
    std::filesystem::path file_;
};

}  // namespace foveray::scene
