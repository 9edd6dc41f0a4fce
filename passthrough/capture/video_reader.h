#pragma once

#include <filesystem>
#include <memory>

#include "passthrough/recorded_camera.h"

namespace foveray::passthrough {

/// A video file in any format that OpenCV's FFmpeg decodes, at the constant frame rate that the file states.
/// Throws Fault(BadInput) when the file is missing, is no video, or states no size or frame rate.
std::unique_ptr<PictureReader> open_video(const std::filesystem::path& file);

}  // namespace foveray::passthrough
