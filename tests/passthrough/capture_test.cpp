#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

#include "base/error.h"
#include "passthrough/capture/image_sequence_reader.h"
#include "passthrough/capture/open_camera.h"
#include "passthrough/capture/video_reader.h"
#include "passthrough/capture/video_writer.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray::passthrough {
namespace {

namespace fs = std::filesystem;

Image plain(std::uint32_t width, std::uint32_t height, std::array<std::uint8_t, 3> colour) {
    Image image(width, height, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = colour[i % 3];
    return image;
}

/// One plain picture for each shade of red.
fs::path write_video(const fs::path& file, std::uint32_t width, std::uint32_t height, double rate,
                     const std::vector<std::uint8_t>& reds) {
    VideoWriter writer(file, width, height, rate);
    for (const std::uint8_t red : reds) writer.write(plain(width, height, {red, 60, 140}));
    writer.finish();
    return file;
}

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const Fault& fault) {
        EXPECT_EQ(fault.code(), ExitCode::BadInput);
        EXPECT_EQ(std::string(fault.what()).find('\n'), std::string::npos);
        return fault.what();
    }
    return "";
}

TEST(Video, ComesBackAsWritten) {
    const fakes::TemporaryFolder folder;
    const fs::path file = write_video(folder / "v.mp4", 64, 48, 25.0, {40, 120, 200});
    Camera camera = open_camera(file.string(), std::nullopt);
    EXPECT_EQ(camera.source->picture_size(), uvec2(64, 48));
    EXPECT_EQ(camera.calibration.focal.x, 32.0);
    const std::array<int, 4> reds{40, 120, 200, 40};  // starts again
    for (int i = 0; i < 4; ++i) {
        const Nanoseconds time = i * 40 * nanoseconds_per_millisecond;
        const CameraFramePtr frame = camera.source->at(time);
        EXPECT_EQ(frame->capture_time, time);
        ASSERT_EQ(frame->picture.channels, 4u);
        const std::uint8_t* pixel = frame->picture.at(31, 20);
        EXPECT_NEAR(pixel[0], reds[i], 4);
        EXPECT_NEAR(pixel[1], 60, 4);
        EXPECT_NEAR(pixel[2], 140, 4);
        EXPECT_EQ(pixel[3], 255);
    }
}

TEST(Video, IsH264In420) {
    const fakes::TemporaryFolder folder;
    const fs::path file = write_video(folder / "v.mp4", 65, 49, 30.0, {10, 20});
    cv::VideoCapture video(file.string(), cv::CAP_FFMPEG);
    const int fourcc = static_cast<int>(video.get(cv::CAP_PROP_FOURCC));  // OpenCV 4.10 tells the codec's own
    EXPECT_TRUE(fourcc == cv::VideoWriter::fourcc('a', 'v', 'c', '1') ||
                fourcc == cv::VideoWriter::fourcc('h', '2', '6', '4'))
        << fourcc;
    EXPECT_EQ(static_cast<int>(video.get(cv::CAP_PROP_CODEC_PIXEL_FORMAT)),
              cv::VideoWriter::fourcc('I', '4', '2', '0'));
    EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_WIDTH), 64);
    EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_HEIGHT), 48);
    EXPECT_EQ(video.get(cv::CAP_PROP_FPS), 30.0);
}

TEST(Video, FaultsAreOneLineWithTheFile) {
    const fakes::TemporaryFolder folder;
    EXPECT_NE(refusal([] { open_video("no/such.mp4"); }).find("no/such.mp4: cannot be opened"),
              std::string::npos);
    const fs::path junk = folder.write("junk.mp4", "this is no video");
    EXPECT_NE(refusal([&] { open_video(junk); }).find("junk.mp4: is not a video"), std::string::npos);
    const fs::path whole = write_video(folder / "whole.mp4", 64, 48, 25.0, {40, 120, 200});
    fs::resize_file(whole, fs::file_size(whole) / 2);
    EXPECT_NE(refusal([&] { open_video(whole); }).find("whole.mp4: is not a video"), std::string::npos);
    EXPECT_NE(refusal([] { VideoWriter("no/such/folder/v.mp4", 64, 48, 25.0); }).find("cannot be written"),
              std::string::npos);
    EXPECT_NE(
        refusal([] { open_camera("/dev/video0", std::nullopt); }).find("live cameras are not supported yet"),
        std::string::npos);
}

TEST(ImageSequence, FolderByName) {
    const fakes::TemporaryFolder folder;
    write_png(folder / "b.png", plain(4, 2, {20, 0, 0}));
    write_png(folder / "a.png", plain(4, 2, {10, 0, 0}));
    folder.write("notes.txt", "not a picture");
    auto reader = open_image_sequence(folder.path().string());
    EXPECT_EQ(reader->picture_size(), uvec2(4, 2));
    ASSERT_TRUE(reader->step());
    EXPECT_EQ(reader->picture().at(0, 0)[0], 10);
    ASSERT_TRUE(reader->step());
    EXPECT_EQ(reader->picture().at(3, 1)[0], 20);
    EXPECT_EQ(reader->picture().at(3, 1)[3], 255);
    EXPECT_FALSE(reader->step());
    EXPECT_EQ(reader->time_of(1), 33'333'333);
    EXPECT_EQ(reader->time_of(2), 66'666'667);
}

TEST(ImageSequence, NumberedPatternByNumber) {
    const fakes::TemporaryFolder folder;
    for (const int number : {2, 10, 9}) {
        write_png(folder / ("f_" + std::to_string(number) + ".png"),
                  plain(2, 2, {static_cast<std::uint8_t>(number), 0, 0}));
    }
    write_png(folder / "f_x.png", plain(2, 2, {99, 0, 0}));
    const std::string pattern = (folder / "f_%d.png").string();
    EXPECT_TRUE(is_image_sequence(pattern));
    auto reader = open_image_sequence(pattern);
    std::vector<int> order;
    while (reader->step()) order.push_back(reader->picture().pixels[0]);
    EXPECT_EQ(order, (std::vector<int>{2, 9, 10}));
    EXPECT_NE(
        refusal([&] { open_image_sequence((folder / "f_%04d.png").string()); }).find("names no pictures"),
        std::string::npos);
}

TEST(ImageSequence, WildcardByName) {
    const fakes::TemporaryFolder folder;
    write_png(folder / "l1.png", plain(2, 2, {1, 0, 0}));
    write_png(folder / "r1.png", plain(2, 2, {2, 0, 0}));
    write_png(folder / "l2.png", plain(2, 2, {3, 0, 0}));
    auto reader = open_image_sequence((folder / "l*.png").string());
    std::vector<int> order;
    while (reader->step()) order.push_back(reader->picture().pixels[0]);
    EXPECT_EQ(order, (std::vector<int>{1, 3}));
}

TEST(ImageSequence, FramesCsvGivesOrderAndTimes) {
    const fakes::TemporaryFolder folder;
    write_png(folder / "a.png", plain(2, 2, {1, 0, 0}));
    write_png(folder / "b.png", plain(2, 2, {2, 0, 0}));
    folder.write("frames.csv", "time_ns,file\n5000000,b.png\n45000000,a.png\n");
    Camera camera = open_camera(folder.path().string(), std::nullopt);
    EXPECT_EQ(camera.source->at(44'999'999)->picture.pixels[0], 2);
    EXPECT_EQ(camera.source->at(45'000'000)->picture.pixels[0], 1);
    EXPECT_EQ(camera.source->at(45'000'000)->capture_time, 45'000'000);
    EXPECT_EQ(camera.source->at(85'000'000)->picture.pixels[0], 2);
    EXPECT_EQ(camera.source->at(85'000'000)->capture_time, 85'000'000);
}

TEST(ImageSequence, FaultsNameFileAndRow) {
    const fakes::TemporaryFolder folder;
    const std::string path = folder.path().string();
    EXPECT_NE(refusal([&] { open_image_sequence(path); }).find("names no pictures"), std::string::npos);
    EXPECT_NE(refusal([] { open_image_sequence("no/such/f_%d.png"); }).find("no such folder"),
              std::string::npos);
    write_png(folder / "a.png", plain(2, 2, {1, 0, 0}));
    folder.write("frames.csv", "time_ns,file\n0,a.png\n0,a.png\n");
    EXPECT_NE(refusal([&] { open_image_sequence(path); }).find("frames.csv:3: its time"), std::string::npos);
    folder.write("frames.csv", "time_ns,file\n0,gone.png\n");
    EXPECT_NE(refusal([&] { open_image_sequence(path); }).find("frames.csv:2: there is no file 'gone.png'"),
              std::string::npos);
    folder.write("frames.csv", "time_ns,file\n");
    EXPECT_NE(refusal([&] { open_image_sequence(path); }).find("lists no pictures"), std::string::npos);
    fs::remove(folder / "frames.csv");

    write_png(folder / "b.png", plain(4, 4, {1, 0, 0}));
    folder.write("c.png", "no picture");
    auto reader = open_image_sequence(path);
    reader->step();
    reader->step();
    EXPECT_NE(refusal([&] { reader->picture(); }).find("b.png: its size differs"), std::string::npos);
    reader->step();
    EXPECT_NE(refusal([&] { reader->picture(); }).find("c.png: not a readable image"), std::string::npos);
}

TEST(OpenCamera, FitsTheCalibrationToThePictures) {
    const fakes::TemporaryFolder folder;
    write_png(folder / "a.png", plain(32, 24, {1, 0, 0}));
    const auto calibration = [&](const std::string& height) {
        return folder.write("camera.json",
                            R"({"format": "foveray-calibration", "version": 1, "model": "pinhole",
            "width": 64, "height": )" +
                                height + R"(, "fx": 50, "fy": 51, "cx": 31.5, "cy": 20, "latency_ms": 20})");
    };
    const Camera camera = open_camera(folder.path().string(), calibration("48"));
    EXPECT_EQ(camera.calibration.focal, dvec2(25, 25.5));
    EXPECT_EQ(camera.calibration.size, uvec2(32, 24));
    EXPECT_NE(refusal([&] {
                  open_camera(folder.path().string(), calibration("36"));
              }).find("is for pictures of 64×36"),
              std::string::npos);
}

}  // namespace
}  // namespace foveray::passthrough
