#pragma once

#include <filesystem>
#include <memory>

#include "base/image.h"

namespace foveray::passthrough {

/// Writes an H.264 .mp4 (4:2:0) that browsers play. Odd sizes lose their last column or row, as 4:2:0 has
/// none.
class VideoWriter {
  public:
    /// Pictures of at least 2×2 pixels, `rate_hz` a second. Throws Fault(BadInput) when the file cannot be
    /// created, Fault(Missing) when this machine's OpenCV has no H.264 encoder.
    VideoWriter(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height, double rate_hz);
    ~VideoWriter();
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    /// RGB or RGBA (alpha ignored), sRGB, of the size given above.
    void write(const Image& picture);
    /// Completes the file; call it once, after the last picture. Throws Fault(BadInput) when the disk is
    /// full.
    void finish();

  private:
    struct Encoder;
    std::unique_ptr<Encoder> encoder_;
    std::filesystem::path file_;
};

}  // namespace foveray::passthrough
