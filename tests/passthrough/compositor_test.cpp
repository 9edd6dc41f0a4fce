#include "passthrough/compositor.h"

#include <cmath>
#include <random>

#include "tests/passthrough/compositor_harness.h"

namespace foveray::passthrough {
namespace {

constexpr uvec2 size{32, 24};

/// 8-bit sRGB of a linear value.
int encoded(double linear) {
    const float clamped = std::clamp(static_cast<float>(linear), 0.0f, 1.0f);
    return static_cast<int>(std::lround(255.0f * srgb_from_linear(clamped)));
}

double decoded(int value) { return linear_from_srgb(static_cast<float>(value) / 255.0f); }

#define EXPECT_COLOR(actual, red, green, blue, alpha) \
    do {                                              \
        const glm::u8vec4 shown = (actual);           \
        EXPECT_NEAR(shown[0], red, 1);                \
        EXPECT_NEAR(shown[1], green, 1);              \
        EXPECT_NEAR(shown[2], blue, 1);               \
        EXPECT_EQ(shown[3], alpha);                   \
    } while (false)

/// A view that coincides with a camera whose picture is plain.
CompositorSetup over_camera(glm::u8vec3 color) {
    CompositorSetup setup;
    setup.view = wide_view(size);
    setup.calibration = default_calibration(size);
    setup.moment.picture = camera_frame(plain_picture(size, color));
    setup.settings.tone_mapping = "none";
    return setup;
}

CompositorSetup without_camera(Background background) {
    CompositorSetup setup;
    setup.view = wide_view(size);
    setup.background = background;
    setup.settings.tone_mapping = "none";
    return setup;
}

void set_everywhere(CompositorSetup& setup, const VirtualPixel& pixel) {
    setup.virtual_part = [pixel](auto, auto) { return pixel; };
}

TEST_F(CompositorTest, WithoutVirtualPartTheCameraPictureComesOutUnchanged) {
    CompositorSetup setup = over_camera({});
    setup.settings.tone_mapping = "neutral";  // never touches the camera
    foveray::Image picture(size.x, size.y, 4);
    std::mt19937 random(7);
    for (std::uint8_t& value : picture.pixels) value = static_cast<std::uint8_t>(random());
    picture.at(3, 2)[0] = picture.at(3, 2)[1] = picture.at(3, 2)[2] = 255;
    setup.moment.picture = camera_frame(picture);
    const Composite result = compose(setup);
    for (std::uint32_t y = 0; y < size.y; ++y) {
        for (std::uint32_t x = 0; x < size.x; ++x) {
            const std::uint8_t* expected = picture.at(x, y);
            EXPECT_COLOR(result.at(x, y), expected[0], expected[1], expected[2], 255);
        }
    }
}

TEST_F(CompositorTest, FullCoverageHidesTheCamera) {
    CompositorSetup setup = over_camera({200, 10, 90});
    set_everywhere(setup, {.radiance = {0.5f, 0.25f, 0.125f, 1.0f}});
    EXPECT_COLOR(compose(setup).at(11, 7), encoded(0.5), encoded(0.25), encoded(0.125), 255);
}

TEST_F(CompositorTest, HalfCoverageMixesInLinearLight) {
    CompositorSetup setup = over_camera({200, 10, 90});
    set_everywhere(setup, {.radiance = {0.25f, 0.125f, 0.0625f, 0.5f}});
    EXPECT_COLOR(compose(setup).at(30, 20), encoded(0.25 + 0.5 * decoded(200)),
                 encoded(0.125 + 0.5 * decoded(10)), encoded(0.0625 + 0.5 * decoded(90)), 255);
}

TEST_F(CompositorTest, ShadowMultipliesAndBounceAddsToTheRealPart) {
    CompositorSetup setup = over_camera({200, 100, 90});
    set_everywhere(setup, {.transmittance = {0.5f, 0.25f, 1.0f}});
    EXPECT_COLOR(compose(setup).at(5, 5), encoded(0.5 * decoded(200)), encoded(0.25 * decoded(100)), 90, 255);
    set_everywhere(setup, {.added = {0.125f, 0.0f, 0.25f}});
    EXPECT_COLOR(compose(setup).at(5, 5), encoded(decoded(200) + 0.125), 100, encoded(decoded(90) + 0.25),
                 255);
    set_everywhere(setup, {.radiance = {0, 0, 0, 0.75f}, .transmittance = vec3(0.5f), .added = vec3(0.125f)});
    EXPECT_COLOR(compose(setup).at(5, 5), encoded(0.25 * (0.5 * decoded(200) + 0.125)),
                 encoded(0.25 * (0.5 * decoded(100) + 0.125)), encoded(0.25 * (0.5 * decoded(90) + 0.125)),
                 255);
}

/// Khronos PBR Neutral, written again from its specification.
std::array<double, 3> neutral(std::array<double, 3> c) {
    const double x = std::min({c[0], c[1], c[2]});
    const double f = x <= 0.08 ? x - x * x / (4 * 0.04) : 0.04;
    for (double& v : c) v -= f;
    const double p = std::max({c[0], c[1], c[2]});
    const double ks = 0.8 - 0.04, kd = 0.15;
    if (p <= ks) return c;
    const double pn = 1 - (1 - ks) * (1 - ks) / (p + 1 - 2 * ks);
    const double g = 1 / (kd * (p - pn) + 1);
    for (double& v : c) v = v * pn / p * g + pn * (1 - g);
    return c;
}

TEST_F(CompositorTest, TonemapsTheVirtualColourWithoutItsCoverage) {
    for (const std::array<double, 3> color :
         {std::array{0.5, 0.3, 0.2}, std::array{0.09, 0.08, 0.07}, std::array{4.0, 2.0, 1.0},
          std::array{0.9, 0.1, 0.0}, std::array{1.0, 1.0, 1.0}, std::array{50.0, 50.0, 60.0}}) {
        const auto expected = neutral(color);
        for (const double coverage : {1.0, 0.5, 0.125}) {
            CompositorSetup setup = over_camera({0, 0, 0});
            setup.settings.tone_mapping = "neutral";
            const auto part = [&](int i) { return static_cast<float>(color[i] * coverage); };
            set_everywhere(setup, {.radiance = {part(0), part(1), part(2), static_cast<float>(coverage)}});
            EXPECT_COLOR(compose(setup).at(1, 1), encoded(coverage * expected[0]),
                         encoded(coverage * expected[1]), encoded(coverage * expected[2]), 255);
        }
    }
}

TEST_F(CompositorTest, ExposuresAreStops) {
    CompositorSetup setup = over_camera({100, 100, 100});
    setup.settings.exposure_ev = 1;
    set_everywhere(setup, {.radiance = {0.1f, 0.2f, 0.05f, 0.5f}});
    EXPECT_COLOR(compose(setup).at(9, 9), encoded(0.2 + 0.5 * decoded(100)),
                 encoded(0.4 + 0.5 * decoded(100)), encoded(0.1 + 0.5 * decoded(100)), 255);
    setup.settings.camera_exposure_ev = -2;
    EXPECT_COLOR(compose(setup).at(9, 9), encoded(0.2 + 0.125 * decoded(100)),
                 encoded(0.4 + 0.125 * decoded(100)), encoded(0.1 + 0.125 * decoded(100)), 255);
}

TEST_F(CompositorTest, LeavesTheRealWorldToTheRuntimeAsPremultipliedAlpha) {
    CompositorSetup setup = without_camera(Background::Runtime);
    EXPECT_COLOR(compose(setup).at(2, 2), 0, 0, 0, 0);
    set_everywhere(setup, {.radiance = {0.5f, 0.25f, 0.125f, 1.0f}});
    EXPECT_COLOR(compose(setup).at(2, 2), encoded(0.5), encoded(0.25), encoded(0.125), 255);
    // The sRGB curve comes after the multiplication by coverage.
    set_everywhere(setup, {.radiance = {0.25f, 0.125f, 0.0625f, 0.5f}});
    EXPECT_COLOR(compose(setup).at(2, 2), encoded(0.25), encoded(0.125), encoded(0.0625), 128);
    set_everywhere(
        setup, {.radiance = {0, 0, 0, 0.5f}, .transmittance = {0.5f, 0.25f, 0.125f}, .added = vec3(0.25f)});
    const double luminance = 0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722 * 0.125;
    const int expected_alpha = static_cast<int>(std::lround(255 * (1 - 0.5 * luminance)));
    EXPECT_COLOR(compose(setup).at(2, 2), encoded(0.125), encoded(0.125), encoded(0.125), expected_alpha);
}

TEST_F(CompositorTest, OpaqueWithoutCameraStandsBeforeTheEnvironment) {
    CompositorSetup setup = without_camera(Background::Environment);
    set_everywhere(setup, {.radiance = {0.25f, 0, 0, 0.5f}});
    EXPECT_COLOR(compose(setup).at(2, 2), encoded(0.25), 0, 0, 255);
    setup.environment = vec3(0.5f, 0.25f, 1.0f);
    EXPECT_COLOR(compose(setup).at(2, 2), encoded(0.5), encoded(0.125), encoded(0.5), 255);
    setup.settings.tone_mapping = "neutral";
    setup.settings.environment_intensity = 0.5f;
    set_everywhere(setup, {});
    const auto expected = neutral({0.25, 0.125, 0.5});
    EXPECT_COLOR(compose(setup).at(2, 2), encoded(expected[0]), encoded(expected[1]), encoded(expected[2]),
                 255);
}

TEST_F(CompositorTest, TheEnvironmentStandsStillInTheWorld) {
    CompositorSetup setup = without_camera(Background::Environment);
    setup.environment = vec3(0);
    setup.environment_picture = FloatImage(4, 2, 4);
    // Texel centres lie at azimuths -135, -45, 45, 135 degrees (to the right of -z) and 45 degrees up and
    // down.
    const auto texel = [&](std::uint32_t x, std::uint32_t y) { return setup.environment_picture.at(x, y); };
    for (std::uint32_t i = 0; i < 8; ++i) texel(i % 4, i / 4)[0] = static_cast<float>(i) / 8;
    setup.view.size = {1, 1};
    setup.view.stage_from_eye.orientation = glm::angleAxis(pi / 4, vec3(1, 0, 0));      // up
    setup.moment.world_from_stage.orientation = glm::angleAxis(pi / 4, vec3(0, 1, 0));  // to the left
    EXPECT_COLOR(compose(setup).at(0, 0), encoded(1.0 / 8), 0, 0, 255);
    setup.view.stage_from_eye.orientation = glm::angleAxis(-pi / 4, vec3(1, 0, 0));
    setup.moment.world_from_stage.orientation = glm::angleAxis(-pi * 3 / 4, vec3(0, 1, 0));
    EXPECT_COLOR(compose(setup).at(0, 0), encoded(7.0 / 8), 0, 0, 255);
}

TEST_F(CompositorTest, EnvironmentStandsInWhereTheCameraDidNotSee) {
    CompositorSetup setup = over_camera({200, 100, 50});
    setup.environment = vec3(0.25f);
    // Turned by 45 degrees, the camera's right edge is in the middle of the view.
    setup.view.stage_from_eye.orientation = glm::angleAxis(-pi / 4, vec3(0, 1, 0));
    const Composite result = compose(setup);
    EXPECT_COLOR(result.at(14, 12), 200, 100, 50, 255);
    EXPECT_COLOR(result.at(17, 12), encoded(0.25), encoded(0.25), encoded(0.25), 255);
    setup.moment.picture = nullptr;  // not yet delivered
    EXPECT_COLOR(compose(setup).at(14, 12), encoded(0.25), encoded(0.25), encoded(0.25), 255);
}

TEST_F(CompositorTest, TheCameraDoesNotSeeBehindItselfOrWhereItsLensModelFoldsBack) {
    CompositorSetup setup = over_camera({200, 100, 50});
    setup.view.stage_from_eye.orientation = glm::angleAxis(pi, vec3(0, 1, 0));
    EXPECT_COLOR(compose(setup).at(15, 12), 0, 0, 0, 255);
    setup.calibration->distortion[0] = -0.4;  // folds at a tangent of 0.91
    setup.view.stage_from_eye.orientation = glm::angleAxis(-pi / 4, vec3(0, 1, 0));
    const Composite result = compose(setup);
    EXPECT_COLOR(result.at(10, 12), 200, 100, 50, 255);
    EXPECT_COLOR(result.at(15, 12), 0, 0, 0, 255);
}

TEST_F(CompositorTest, ProjectsDepthAsTheViewsMatrixDoes) {
    CompositorSetup setup = over_camera({0, 0, 0});
    setup.settings.near_m = 0.1f;
    setup.settings.far_m = 50.0f;
    setup.virtual_part = [](std::uint32_t x, std::uint32_t) {
        return VirtualPixel{.depth = x == 31 ? std::numeric_limits<float>::infinity()
                                             : 0.05f * std::exp2(static_cast<float>(x) / 3)};
    };
    const Composite result = compose(setup);
    const mat4 clip = clip_from_eye(setup.view.fov, 0.1f, 50.0f);
    for (std::uint32_t x = 0; x < 31; ++x) {
        const vec4 p = clip * vec4(0, 0, -0.05f * std::exp2(static_cast<float>(x) / 3), 1);
        EXPECT_NEAR(result.depth[x], std::clamp(p.z / p.w, 0.0f, 1.0f), 1e-5f) << x;
    }
    EXPECT_EQ(result.depth[31], 1.0f);
    EXPECT_EQ(result.depth[0], 0.0f);
}

TEST_F(CompositorTest, HiddenPixelsAreBlack) {
    CompositorSetup setup = over_camera({200, 100, 50});
    setup.virtual_part = [](std::uint32_t x, std::uint32_t) {
        return VirtualPixel{.radiance = vec4(1, 1, 1, x % 2), .visible = x > 3};
    };
    const Composite result = compose(setup);
    EXPECT_COLOR(result.at(2, 0), 0, 0, 0, 255);
    EXPECT_COLOR(result.at(3, 0), 0, 0, 0, 255);
    EXPECT_COLOR(result.at(4, 0), 200, 100, 50, 255);
}

TEST(ChooseBackground, CameraFirstThenWhatTheHeadsetOffers) {
    Settings settings;
    EXPECT_EQ(choose_background(true, BlendMode::Opaque, settings), Background::Camera);
    EXPECT_EQ(choose_background(true, BlendMode::AlphaBlend, settings), Background::Camera);
    EXPECT_EQ(choose_background(false, BlendMode::Opaque, settings), Background::Environment);
    EXPECT_EQ(choose_background(false, BlendMode::AlphaBlend, settings), Background::Runtime);
    EXPECT_EQ(choose_background(false, BlendMode::Additive, settings), Background::Runtime);
    settings.camera_blend = false;
    EXPECT_EQ(choose_background(true, BlendMode::Opaque, settings), Background::Environment);
    EXPECT_EQ(choose_background(true, BlendMode::AlphaBlend, settings), Background::Runtime);
}

}  // namespace
}  // namespace foveray::passthrough
