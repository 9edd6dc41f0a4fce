#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "base/session.h"
#include "passthrough/capture/open_camera.h"
#include "render/scene/load_scene.h"
#include "render/user_shapes/shape_store.h"

namespace foveray::app {

/// What a command shows: its own options first, then what the session was recorded with.
struct Inputs {
    std::filesystem::path scene_file;
    std::shared_ptr<const scene::Scene> scene;
    std::vector<std::filesystem::path> scene_files;  // that the scene was read from
    user_shapes::ShapeStore shapes;
    render::UserShaders user_shaders;  // of the scene's files
    std::string camera_name;           // empty: none
    std::optional<passthrough::Camera> camera;
};

/// `session` may be null. Without any scene the demo's is taken. Throws Fault.
Inputs load_inputs(const PictureOptions& options, const Session* session);

}  // namespace foveray::app
