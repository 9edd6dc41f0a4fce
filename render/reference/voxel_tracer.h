#pragma once

#include <optional>

#include "render/reference/shape_tracer.h"
#include "render/scene/voxels.h"

namespace foveray::reference {

/// Where the ray first enters a voxel, at full resolution; it sees nothing of the voxel that it starts in.
/// The normal is the one that the voxel holds, or its face's if it shows faces. `tint` is the voxel's colour,
/// `inside` whether the normal turns away.
std::optional<Crossing> first_voxel(const scene::Voxels& voxels, const Ray& ray);

}  // namespace foveray::reference
