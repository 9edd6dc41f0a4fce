#pragma once

#include <memory>
#include <string>

#include "passthrough/recorded_camera.h"

namespace foveray::passthrough {

constexpr double default_sequence_rate_hz = 30.0;

/// True when `source` names an image sequence rather than one file.
bool is_image_sequence(const std::string& source);

/// `source` is a folder (all its PNG, JPEG, BMP and TGA files by name), a pattern as in printf with one %d or
/// %04d in the file's name (by number, gaps allowed), or a pattern with * and ? in the file's name (by name).
/// Pictures follow each other at 30 Hz, unless the folder holds frames.csv with the columns time_ns and file:
/// then that table gives both order and times. Throws Fault(BadInput) when there is no picture, a listed file
/// is missing, times do not grow, or, while reading, when a picture cannot be decoded or its size differs.
std::unique_ptr<PictureReader> open_image_sequence(const std::string& source);

}  // namespace foveray::passthrough
