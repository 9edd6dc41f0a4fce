#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/image.h"
#include "base/time.h"

namespace foveray::passthrough {

/// One picture of a camera.
struct CameraFrame {
    Nanoseconds capture_time = 0;  // session clock: middle of the exposure
    std::uint64_t sequence = 0;    // grows with every picture of a source; gaps where pictures were dropped
    Image picture;                 // RGBA, sRGB, alpha 255; as the lens drew it, distorted
    std::string source;            // what it came from, for messages
};

using CameraFramePtr = std::shared_ptr<const CameraFrame>;

}  // namespace foveray::passthrough
