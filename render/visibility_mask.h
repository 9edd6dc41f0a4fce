#pragma once

#include <cstdint>
#include <vector>

#include "base/frame.h"
#include "base/view.h"
#include "shaders/shared/sample_grid.h"

namespace foveray::render {

/// Words of one view's mask: a bit a cell, HIDDEN_MASK_SIZE cells a side, row by row from the top, lowest bit
/// first.
constexpr std::size_t hidden_mask_words =
    std::size_t{shared::HIDDEN_MASK_SIZE} * shared::HIDDEN_MASK_SIZE / 32;

/// Which cells of a view its wearer cannot see. Conservative: a bit is set only where the mesh covers the
/// whole cell, however its triangles share it or overlap. Returns no words when no cell is hidden.
std::vector<std::uint32_t> hidden_cells(const HiddenMesh& mesh, const Fov& fov);

}  // namespace foveray::render
