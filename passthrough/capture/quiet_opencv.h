#pragma once

#include <cstdlib>

#include <opencv2/core/utils/logger.hpp>

namespace foveray::passthrough {

/// Keeps OpenCV and FFmpeg from writing to standard error; what went wrong is said by a Fault.
inline void quiet_opencv() {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
}

}  // namespace foveray::passthrough
