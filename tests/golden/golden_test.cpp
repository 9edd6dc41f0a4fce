#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "app/offscreen/offscreen.h"
#include "render/scene/load_scene.h"
#include "render/user_shapes/compile.h"
#include "tests/fakes/gpu_fixture.h"

/// Pictures of the shipped scenes against those in pictures/, which were looked at. FOVERAY_GOLDEN_UPDATE=1
/// writes them anew; a failure leaves the picture and the difference in the build folder's
/// tests/golden/failures.
namespace foveray::app {
namespace {

namespace fs = std::filesystem;

// Lavapipe's versions round differently, and a ray at an edge or a fractal's rim then takes the other side.
constexpr double mean_tolerance = 0.4;      // of 255
constexpr int pixel_tolerance = 24;         // of 255
constexpr double outlier_tolerance = 0.01;  // part of the pixels

struct Golden {
    const char* scene;
    double seconds;
    bool polar;
    int frames = 1;  // drawn, a tenth of a second apart: probes gather light over time
};

std::ostream& operator<<(std::ostream& out, const Golden& g) { return out << g.scene; }

std::string name_of(const Golden& golden) {
    return fs::path(golden.scene).stem().string() + (golden.polar ? "_polar" : "");
}

Shot shot_of(const Golden& golden, const scene::Scene& scene) {
    Shot shot;
    shot.time = static_cast<Nanoseconds>(golden.seconds * 1e9);
    shot.views = {camera_view(scene, uvec2(240, 135))};
    shot.every_pixel = !golden.polar;
    shot.acuity = {60.0f, 3.0f, 20.0f, 60.0f};
    shot.gaze_origin = shot.views[0].stage_from_eye.position;
    shot.gaze_direction = transform_direction(shot.views[0].stage_from_eye, vec3(0, 0, -1));
    shot.settings.shadow_samples = 16;
    shot.settings.ambient_occlusion_samples = 32;
    shot.settings.reference_samples = 4;
    return shot;
}

struct Difference {
    double mean = 0.0, outliers = 0.0;
    Image picture;
};

Difference compare(const Image& a, const Image& b) {
    Difference d;
    d.picture = Image(a.width, a.height, 4);
    std::size_t outliers = 0;
    for (std::size_t pixel = 0; pixel < a.pixels.size(); pixel += 4) {
        int largest = 0;
        for (std::size_t c = pixel; c < pixel + 3; ++c) {
            const int difference = std::abs(int{a.pixels[c]} - int{b.pixels[c]});
            d.mean += difference;
            largest = std::max(largest, difference);
            d.picture.pixels[c] = static_cast<std::uint8_t>(std::min(255, 8 * difference));
        }
        d.picture.pixels[pixel + 3] = 255;
        outliers += largest > pixel_tolerance;
    }
    const double pixels = static_cast<double>(a.pixels.size()) / 4.0;
    d.mean /= 3.0 * pixels;
    d.outliers = static_cast<double>(outliers) / pixels;
    return d;
}

class GoldenTest : public fakes::GpuTest, public testing::WithParamInterface<Golden> {};

TEST_P(GoldenTest, LooksAsItDid) {
    const Golden golden = GetParam();
    const scene::Scene scene = scene::load_scene(assets_folder() / "scenes" / golden.scene);
    render::UserShaders user_shaders;
    for (const scene::UserShape& user : scene.user_shapes) user_shaders.push_back(user_shapes::compile(user));
    Offscreen offscreen(device(), scene, 1, user_shaders);
    Shot shot = shot_of(golden, scene), small = shot;
    small.views[0].size = uvec2(1);
    for (int i = golden.frames - 1; i > 0; --i) {
        small.time = shot.time - Nanoseconds{i} * 100'000'000;
        offscreen.draw(small);
    }
    offscreen.draw(shot);
    const Image picture = offscreen.picture(0);

    const fs::path file = fs::path(GOLDEN_PICTURES) / (name_of(golden) + ".png");
    if (std::getenv("FOVERAY_GOLDEN_UPDATE")) {
        write_png(file, picture);
        GTEST_SKIP() << "wrote " << file;
    }
    const Image expected = read_image(file, 4);
    ASSERT_EQ(picture.width, expected.width);
    ASSERT_EQ(picture.height, expected.height);
    const Difference difference = compare(picture, expected);
    EXPECT_LE(difference.mean, mean_tolerance);
    EXPECT_LE(difference.outliers, outlier_tolerance);
    if (HasFailure()) {
        const fs::path folder = GOLDEN_FAILURES;
        write_png(folder / (name_of(golden) + ".png"), picture);
        write_png(folder / (name_of(golden) + "_difference.png"), difference.picture);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, GoldenTest,
    testing::Values(Golden{"proceduray.json", 0.0, false}, Golden{"proceduray.json", 1.5, true},
                    Golden{"shapes.json", 0.0, false}, Golden{"mixed.json", 0.5, false},
                    Golden{"mixed.json", 0.5, true}, Golden{"cornell.json", 6.0, false, 60}),
    [](const auto& golden) { return name_of(golden.param) + "_" + std::to_string(golden.index); });

}  // namespace
}  // namespace foveray::app
