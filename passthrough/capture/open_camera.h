#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "passthrough/calibration.h"
#include "passthrough/camera_source.h"

namespace foveray::passthrough {

struct Camera {
    std::unique_ptr<CameraSource> source;
    Calibration calibration;  // for the source's picture size
};

/// `source` is a video file or an image sequence (image_sequence_reader.h). Without a calibration file it
/// warns and takes default_calibration. Throws Fault(BadInput) when either cannot be read, the calibration is
/// for pictures of another shape, or `source` is a live device.
Camera open_camera(const std::string& source, const std::optional<std::filesystem::path>& calibration_file);

}  // namespace foveray::passthrough
