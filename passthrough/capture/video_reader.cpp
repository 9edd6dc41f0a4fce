#include "passthrough/capture/video_reader.h"

#include <cmath>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "base/error.h"
#include "passthrough/capture/quiet_opencv.h"

namespace foveray::passthrough {
namespace {

class VideoReader : public PictureReader {
  public:
    explicit VideoReader(const std::filesystem::path& file) : name_(file.string()) {
        if (!std::filesystem::is_regular_file(file))
            throw_bad_input(name_, "cannot be opened", "check the path");
        quiet_opencv();
        rewind();
        size_ = {static_cast<unsigned>(capture_.get(cv::CAP_PROP_FRAME_WIDTH)),
                 static_cast<unsigned>(capture_.get(cv::CAP_PROP_FRAME_HEIGHT))};
        rate_ = capture_.get(cv::CAP_PROP_FPS);
        if (size_.x == 0 || size_.y == 0 || !std::isfinite(rate_) || rate_ <= 0 || rate_ > 1000) {
            throw_bad_input(name_, "states no usable picture size or frame rate",
                            "convert it to an .mp4 video");
        }
    }

    const std::string& name() const override { return name_; }
    uvec2 picture_size() const override { return size_; }
    Nanoseconds time_of(std::uint64_t index) const override {
        return from_seconds(static_cast<double>(index) / rate_);
    }
    bool step() override { return capture_.grab(); }

    Image picture() override {
        cv::Mat decoded;
        if (!capture_.retrieve(decoded) || decoded.empty() || decoded.depth() != CV_8U ||
            decoded.cols != static_cast<int>(size_.x) || decoded.rows != static_cast<int>(size_.y)) {
            throw_bad_input(name_, "holds a picture that cannot be decoded", "convert it to an .mp4 video");
        }
        Image image(size_.x, size_.y, 4);
        cv::Mat rgba(decoded.rows, decoded.cols, CV_8UC4, image.pixels.data());
        cv::cvtColor(decoded, rgba, decoded.channels() == 1 ? cv::COLOR_GRAY2RGBA : cv::COLOR_BGR2RGBA);
        return image;
    }

    /// Opens again: seeking is inexact with some codecs.
    void rewind() override {
        if (!capture_.open(name_, cv::CAP_FFMPEG)) {
            throw_bad_input(name_, "is not a video that can be decoded", "convert it to an .mp4 video");
        }
    }

  private:
    std::string name_;
    cv::VideoCapture capture_;
    uvec2 size_{0};
    double rate_ = 0;
};

}  // namespace

std::unique_ptr<PictureReader> open_video(const std::filesystem::path& file) {
    return std::make_unique<VideoReader>(file);
}

}  // namespace foveray::passthrough
