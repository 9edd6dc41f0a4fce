#pragma once

#include "render/scene/scene.h"
#include "render/scene/voxels.h"

namespace foveray::scene {

/// All triangles of a scene at time 0 as voxels, `resolution` of them (2 to 1024) along the longest side, in
/// the scene's world space. Each triangle is cut along the grid's planes, and each piece gives its colour
/// (base colour, texture, vertex colours) and normal to the voxel it lies in by its area: a voxel is there
/// when a surface crosses it, and no ray slips through. Masked materials leave holes; of blended ones, what
/// is less than half opaque is left out. Nothing, if no triangle is left or if it is too much for a tree.
std::optional<Voxels> voxelize(const Scene& scene, std::uint32_t resolution);

}  // namespace foveray::scene
