// The demo from session to report, as ./run.sh plays it.
#include <gtest/gtest.h>

#include "base/csv.h"
#include "base/image.h"
#include "base/json.h"
#include "tests/demo/run_program.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray {
namespace {

namespace fs = std::filesystem;

using fakes::file_bytes;
using fakes::replay_demo;

/// Mean absolute difference of neighbours in a square of `side` pixels round a place in 0..1: how much
/// detail.
double detail(const Image& image, vec2 place, int side) {
    const int cx = static_cast<int>(place.x * static_cast<float>(image.width));
    const int cy = static_cast<int>(place.y * static_cast<float>(image.height));
    double sum = 0;
    for (int y = cy - side / 2; y < cy + side / 2; ++y) {
        for (int x = cx - side / 2; x < cx + side / 2; ++x) {
            sum += std::abs(static_cast<int>(*image.at(x, y)) - static_cast<int>(*image.at(x + 1, y)));
        }
    }
    return sum / (side * side);
}

double mean_difference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
    return sum / static_cast<double>(a.pixels.size());
}

TEST(Demo, TwiceTheSameBytesAndAReport) {
    const fakes::TemporaryFolder folder;
    const fs::path first = replay_demo(folder, "first", {"--frames", "0:6"});
    const fs::path second = replay_demo(folder, "second", {"--frames", "0:6"});
    std::size_t pictures = 0;
    for (const auto& entry : fs::directory_iterator(first / "frames")) {
        EXPECT_EQ(file_bytes(entry.path()), file_bytes(second / "frames" / entry.path().filename()))
            << entry.path();
        ++pictures;
    }
    EXPECT_EQ(pictures, 6u * 6u);  // two merged pictures and four views a frame

    const CsvTable metrics = CsvTable::read(first / "metrics.csv");
    EXPECT_EQ(metrics.row_count(), 6u);
    for (std::size_t row = 0; row < metrics.row_count(); ++row) {
        EXPECT_GT(metrics.number(row, metrics.column("rays_primary")), 10000);
        EXPECT_GT(metrics.number(row, metrics.column("rays_shadow")), 10000);
        EXPECT_GT(metrics.number(row, metrics.column("rays_reflection")), 100);
        for (const char* stage :
             {"sampling_ms", "primary_ms", "lighting_ms", "resolve_ms", "compositor_ms"}) {
            EXPECT_GT(metrics.number(row, metrics.column(stage)), 0.0) << stage;
        }
    }
    const Json summary = read_json(first / "summary.json");
    EXPECT_FALSE(summary.empty());
    EXPECT_GT(fs::file_size(first / "video.mp4"), 1000u);
    EXPECT_GT(fs::file_size(first / "report.html"), 10000u);
}

TEST(Demo, FramesMayStartLaterAndStayTheSame) {
    const fakes::TemporaryFolder folder;
    const fs::path whole = replay_demo(folder, "whole", {"--frames", "0:4", "--headset", "ci"});
    const fs::path tail = replay_demo(folder, "tail", {"--frames", "3:4", "--headset", "ci"});
    EXPECT_FALSE(fs::exists(tail / "frames/frame_00002_left.png"));
    EXPECT_EQ(file_bytes(whole / "frames/frame_00003_left.png"),
              file_bytes(tail / "frames/frame_00003_left.png"));
}

TEST(Demo, IsSharpUnderTheGazeAndShowsTheRoom) {
    const fakes::TemporaryFolder folder;
    const fs::path polar = replay_demo(folder, "polar", {"--frames", "2:3"});
    const fs::path full = replay_demo(folder, "full", {"--frames", "2:3", "--reference"});
    const Image a = read_image(polar / "frames/frame_00002_left.png", 3);
    const Image b = read_image(full / "frames/frame_00002_left.png", 3);
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    EXPECT_LT(mean_difference(a, b), 6.0) << "the same picture but for the periphery";
    // The vase stands under the gaze, the plant pot far from it: detail is kept there and lost here.
    const vec2 vase(0.535f, 0.52f), plant(0.75f, 0.75f);
    EXPECT_GT(detail(a, vase, 60), 0.6 * detail(b, vase, 60));
    EXPECT_LT(detail(a, plant, 80) / detail(b, plant, 80), 0.6 * detail(a, vase, 60) / detail(b, vase, 60));
    // The room: the wall's green and the cushion's yellow come from the camera and go with it.
    const fs::path alone = replay_demo(folder, "alone", {"--frames", "2:3", "--set", "camera.blend=off"});
    const Image c = read_image(alone / "frames/frame_00002_left.png", 3);
    ASSERT_EQ(a.pixels.size(), c.pixels.size());
    const auto at = [](const Image& image, vec2 place) {
        return image.at(static_cast<std::uint32_t>(place.x * static_cast<float>(image.width)),
                        static_cast<std::uint32_t>(place.y * static_cast<float>(image.height)));
    };
    const vec2 wall(0.52f, 0.15f), cushion(0.643f, 0.41f);
    EXPECT_GT(at(a, wall)[1], at(a, wall)[0] + 10);
    EXPECT_GT(at(a, cushion)[0], at(a, cushion)[2] + 80);
    EXPECT_LT(std::abs(at(c, cushion)[0] - at(c, cushion)[2]), 80);
}

TEST(Demo, ThrowsAShadowOnTheRealFloor) {
    const fakes::TemporaryFolder folder;
    const fs::path lit =
        replay_demo(folder, "lit", {"--frames", "0:1", "--headset", "ci", "--set", "lighting.shadows=off"});
    const fs::path shadowed = replay_demo(folder, "shadowed", {"--frames", "0:1", "--headset", "ci"});
    const Image a = read_image(lit / "frames/frame_00000_left.png", 3);
    const Image b = read_image(shadowed / "frames/frame_00000_left.png", 3);
    std::size_t darker = 0, brighter = 0;
    for (std::uint32_t y = a.height * 6 / 10; y < a.height; ++y) {
        for (std::uint32_t x = 0; x < a.width; ++x) {
            const int difference = *b.at(x, y) - *a.at(x, y);
            darker += difference < -8;
            brighter += difference > 8;
        }
    }
    EXPECT_GT(darker, 500u);
    EXPECT_LT(brighter, darker / 10);
}

}  // namespace
}  // namespace foveray
