#pragma once

#include <filesystem>

#include "render/scene/voxels.h"

namespace foveray::scene {

/// Reads a MagicaVoxel file (chunks SIZE, XYZI, RGBA, nTRN, nGRP, nSHP; others are skipped): all models where
/// its scene graph puts them, or the first model, standing on the middle of its floor, where there is none.
/// The file's z becomes y. Voxels with all six neighbours are left out, for nobody sees them. Throws
/// Fault(BadInput).
Voxels read_vox(const std::filesystem::path& file, float voxel_size);

}  // namespace foveray::scene
