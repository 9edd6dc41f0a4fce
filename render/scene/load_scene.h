#pragma once

#include <filesystem>
#include <vector>

#include "render/scene/scene.h"

namespace foveray::scene {

/// Loads a .gltf or .glb file, or a foveray scene file (any other name; docs/scene-format.md). A bare glTF
/// file comes with a floor to stand on, 1.5 m in front of the stage's origin, sensibly sized, and default
/// light if it has none. Throws Fault(BadInput) naming the file, the place in it and the remedy. `files`
/// takes the names of the files that were read, of a scene that cannot be loaded those up to there; may be
/// null.
Scene load_scene(const std::filesystem::path& file, std::vector<std::filesystem::path>* files = nullptr);

}  // namespace foveray::scene
