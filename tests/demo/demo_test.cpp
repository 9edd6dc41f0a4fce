// The demo from session to report, as ./run.sh plays it.
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "base/csv.h"
#include "base/headset_profile.h"
#include "base/image.h"
#include "base/json.h"
#include "tests/demo/run_program.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray {
namespace {

namespace fs = std::filesystem;

const std::string session = (assets_folder() / "sessions/demo").string();

std::string bytes(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

fs::path replay(const fakes::TemporaryFolder& folder, const std::string& name,
                std::vector<std::string> more) {
    const fs::path out = folder.path() / name;
    std::vector<std::string> arguments = {"replay", session, "--out", out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = fakes::run_foveray(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err.find("Validation"), std::string::npos) << result.err;
    EXPECT_EQ(result.out, (out / "report.html").string() + "\n");
    return out;
}

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
    const fs::path first = replay(folder, "first", {"--frames", "0:6"});
    const fs::path second = replay(folder, "second", {"--frames", "0:6"});
    std::size_t pictures = 0;
    for (const auto& entry : fs::directory_iterator(first / "frames")) {
        EXPECT_EQ(bytes(entry.path()), bytes(second / "frames" / entry.path().filename())) << entry.path();
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
    const fs::path whole = replay(folder, "whole", {"--frames", "0:4", "--headset", "ci"});
    const fs::path tail = replay(folder, "tail", {"--frames", "3:4", "--headset", "ci"});
    EXPECT_FALSE(fs::exists(tail / "frames/frame_00002_left.png"));
    EXPECT_EQ(bytes(whole / "frames/frame_00003_left.png"), bytes(tail / "frames/frame_00003_left.png"));
}

TEST(Demo, IsSharpUnderTheGazeAndShowsTheRoom) {
    const fakes::TemporaryFolder folder;
    const fs::path polar = replay(folder, "polar", {"--frames", "2:3"});
    const fs::path full = replay(folder, "full", {"--frames", "2:3", "--reference"});
    const Image a = read_image(polar / "frames/frame_00002_left.png", 3);
    const Image b = read_image(full / "frames/frame_00002_left.png", 3);
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    EXPECT_LT(mean_difference(a, b), 6.0) << "the same picture but for the periphery";
    // The vase stands under the gaze, the plant pot far from it: detail is kept there and lost here.
    const Json page = read_json(polar / "summary.json");
    const vec2 vase(0.535f, 0.52f), sphere(0.688f, 0.69f);
    EXPECT_GT(detail(a, vase, 60), 0.6 * detail(b, vase, 60));
    EXPECT_LT(detail(a, sphere, 80) / detail(b, sphere, 80), 0.9 * detail(a, vase, 60) / detail(b, vase, 60));
    // The room: without the camera the same place is black.
    const fs::path alone =
        replay(folder, "alone", {"--frames", "2:3", "--headset", "ci", "--set", "camera.blend=off"});
    EXPECT_NE(bytes(alone / "frames/frame_00002_left.png"), bytes(polar / "frames/frame_00002_left.png"));
}

TEST(Demo, ThrowsAShadowOnTheRealFloor) {
    const fakes::TemporaryFolder folder;
    const fs::path lit =
        replay(folder, "lit", {"--frames", "0:1", "--headset", "ci", "--set", "lighting.shadows=off"});
    const fs::path shadowed = replay(folder, "shadowed", {"--frames", "0:1", "--headset", "ci"});
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
