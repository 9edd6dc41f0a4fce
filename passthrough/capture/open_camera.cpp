#include "passthrough/capture/open_camera.h"

#include "base/error.h"
#include "base/log.h"
#include "passthrough/capture/image_sequence_reader.h"
#include "passthrough/capture/video_reader.h"
#include "passthrough/recorded_camera.h"

namespace foveray::passthrough {
namespace {

std::string text(uvec2 size) { return std::to_string(size.x) + "×" + std::to_string(size.y); }

std::unique_ptr<PictureReader> open_reader(const std::string& source) {
    if (source.starts_with("/dev/")) {
        throw_bad_input(source, "live cameras are not supported yet",
                        "give a video file or an image sequence");
    }
    if (is_image_sequence(source)) return open_image_sequence(source);
    return open_video(source);
}

}  // namespace

Camera open_camera(const std::string& source, const std::optional<std::filesystem::path>& calibration_file) {
    std::unique_ptr<PictureReader> reader = open_reader(source);
    const uvec2 size = reader->picture_size();
    Calibration calibration = default_calibration(size);
    if (calibration_file) {
        const Calibration read = read_calibration(*calibration_file);
        const auto scaled = scaled_to(read, size);
        if (!scaled) {
            throw_bad_input(
                calibration_file->string() + ": /width",
                "is for pictures of " + text(read.size) + ", but " + source + " has " + text(size),
                "use the calibration of this camera and mode");
        }
        calibration = *scaled;
    } else {
        log::warn(
            "{}: no calibration; assuming a lens without distortion, 90 degrees wide, at the head "
            "(--calibration FILE gives the real one)",
            source);
    }
    const Nanoseconds latency = calibration.latency;
    return {std::make_unique<RecordedCamera>(std::move(reader), latency), calibration};
}

}  // namespace foveray::passthrough
