#include "passthrough/capture/video_writer.h"

#include <cassert>
#include <fstream>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "base/error.h"
#include "passthrough/capture/quiet_opencv.h"

namespace foveray::passthrough {

struct VideoWriter::Encoder {
    cv::VideoWriter writer;
    cv::Size size;
    cv::Mat bgr;
};

VideoWriter::VideoWriter(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
                         double rate_hz)
    : encoder_(std::make_unique<Encoder>()), file_(file) {
    assert(width >= 2 && height >= 2 && rate_hz > 0);
    if (!std::ofstream(file)) {
        throw_bad_input(file.string(), "cannot be written", "check the folder's rights and free space");
    }
    quiet_opencv();
    encoder_->size = cv::Size(static_cast<int>(width / 2 * 2), static_cast<int>(height / 2 * 2));
    if (!encoder_->writer.open(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('a', 'v', 'c', '1'),
                               rate_hz, encoder_->size)) {
        throw_missing(file.string(), "OpenCV found no H.264 encoder",
                      "install the distribution's FFmpeg with x264");
    }
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::write(const Image& picture) {
    const cv::Size size = encoder_->size;
    assert(picture.width / 2 * 2 == static_cast<std::uint32_t>(size.width) &&
           picture.height / 2 * 2 == static_cast<std::uint32_t>(size.height));
    assert(picture.channels == 3 || picture.channels == 4);
    const cv::Mat rgb(static_cast<int>(picture.height), static_cast<int>(picture.width),
                      picture.channels == 3 ? CV_8UC3 : CV_8UC4,
                      const_cast<std::uint8_t*>(picture.pixels.data()));
    cv::cvtColor(rgb(cv::Rect(cv::Point(), size)), encoder_->bgr,
                 picture.channels == 3 ? cv::COLOR_RGB2BGR : cv::COLOR_RGBA2BGR);
    encoder_->writer.write(encoder_->bgr);
}

void VideoWriter::finish() {
    encoder_->writer.release();
    // FFmpeg writes the index last; a file that opens and ends with it is complete.
    cv::VideoCapture check;
    if (!check.open(file_.string(), cv::CAP_FFMPEG) || !check.grab()) {
        throw_bad_input(file_.string(), "the video could not be completed", "check the folder's free space");
    }
}

}  // namespace foveray::passthrough
