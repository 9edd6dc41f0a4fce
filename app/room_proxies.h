#pragma once

#include <vector>

#include "render/scene/scene.h"
#include "shaders/shared/room.h"

namespace foveray::app {

/// The scene's real surfaces as boxes round their meshes, stage space: where the camera's picture lies in
/// depth.
std::vector<shared::RoomProxy> room_proxies(const scene::Scene& scene);

}  // namespace foveray::app
