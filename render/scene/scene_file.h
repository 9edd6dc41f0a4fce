#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "render/scene/scene.h"

namespace foveray::scene {

/// The text of docs/scene.schema.json.
std::string_view scene_schema();

/// Loads a foveray scene file (docs/scene-format.md). Throws Fault(BadInput) with file and place. `files`: as
/// of load_scene.
Scene load_scene_file(const std::filesystem::path& file, std::vector<std::filesystem::path>* files = nullptr);

}  // namespace foveray::scene
