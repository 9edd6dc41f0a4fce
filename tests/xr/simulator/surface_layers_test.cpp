// Where quads, cylinders and equirectangular layers appear, and which part of which picture they show.
#include <cmath>

#include "tests/xr/simulator/composed.h"

namespace foveray::simulator_tests {
namespace {

using SurfaceLayers = Composed;

XrPosef turned(float degrees_about_y, vec3 position) {
    const float half = radians(degrees_about_y) / 2;
    return {{0.0f, std::sin(half), 0.0f, std::cos(half)}, {position.x, position.y, position.z}};
}

vec3 placed(const XrPosef& pose, vec3 point) {
    const quat rotation(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
    return rotation * point + vec3(pose.position.x, pose.position.y, pose.position.z);
}

int lit_pixels(const Image& image) {
    int count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) count += image.pixels[i] > 127;
    return count;
}

TEST_F(SurfaceLayers, AQuadIsWhereItsPoseAndSizeSay) {
    start();
    auto quad = make_quad(make_cells());
    quad.size = {1.5f, 1.0f};
    for (const float angle : {0.0f, 35.0f, -35.0f}) {
        quad.pose = turned(angle, {0.3f, -0.2f, -2.0f});
        show_opaque(quad);
        expect_cells(
            [&](vec2 part) {
                return placed(quad.pose, {1.5f * (part.x - 0.5f), 0.5f - part.y, 0.0f});
            },
            16);
    }
    EXPECT_EQ(pixel(shown(0), 10, 10), (Rgb{0, 0, 0}));
}

TEST_F(SurfaceLayers, AQuadCoversAsManyPixelsAsItsSolidAngle) {
    start();
    show_opaque(make_quad(make_plain({255, 255, 255, 255}), 1.0f, 2.0f));
    EXPECT_EQ(lit_pixels(shown(0)), 64 * 64) << "half a unit of tangent, 128 pixels a unit";
    show_opaque(make_quad(make_plain({255, 255, 255, 255}), 0.5f, 4.0f));
    EXPECT_EQ(lit_pixels(shown(1)), 16 * 16);
}

TEST_F(SurfaceLayers, AQuadIsSeenFromItsFrontOnly) {
    start();
    auto quad = make_quad(make_cells());
    quad.pose = turned(180.0f, {0, 0, -2});
    show_opaque(quad);
    expect_uniform(shown(0), {0, 0, 0});
    quad.pose = turned(0.0f, {0, 0, 2});
    show_opaque(quad);
    expect_uniform(shown(0), {0, 0, 0});
    quad.size = {0.0f, 1.0f};
    quad.pose = turned(0.0f, {0, 0, -2});
    show_opaque(quad);
    expect_uniform(shown(0), {0, 0, 0});
}

TEST_F(SurfaceLayers, ACylinderIsBentRoundItsAxis) {
    start();
    auto layer =
        make_layer<XrCompositionLayerCylinderKHR>(XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR, make_cells());
    layer.centralAngle = 1.2f;
    layer.aspectRatio = 1.5f;
    for (const float radius : {2.0f, 0.4f}) {
        layer.radius = radius;
        layer.pose = turned(10.0f, {0.1f, 0.05f, -0.2f});
        show_opaque(layer);
        expect_cells(
            [&](vec2 part) {
                const float angle = 1.2f * (part.x - 0.5f), height = radius * 1.2f / 1.5f;
                return placed(layer.pose, {radius * std::sin(angle), height * (0.5f - part.y),
                                           -radius * std::cos(angle)});
            },
            16);
    }
    layer.radius = INFINITY;  // where the cylinder is makes no difference, nor does the eye
    layer.pose = turned(10.0f, {1.0f, 2.0f, 3.0f});
    show_opaque(layer);
    const Image infinite = shown(0);
    EXPECT_EQ(infinite, shown(1));
    layer.radius = 0.0f;
    show_opaque(layer);
    EXPECT_EQ(infinite, shown(0));
    EXPECT_GT(lit_pixels(infinite), 1000);
}

TEST_F(SurfaceLayers, ACylinderIsSeenFromInsideOnly) {
    start();
    auto layer =
        make_layer<XrCompositionLayerCylinderKHR>(XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR, make_cells());
    layer.centralAngle = 1.0f;
    layer.aspectRatio = 1.0f;
    layer.radius = 1.0f;
    layer.pose = turned(180.0f, {0, 0, -4});  // its outside faces the head
    show_opaque(layer);
    expect_uniform(shown(0), {0, 0, 0});
    layer.pose = turned(0.0f, {0, 0, -4});  // its inside does
    show_opaque(layer);
    expect_cells(
        [&](vec2 part) {
            const float angle = part.x - 0.5f;
            return placed(layer.pose, {std::sin(angle), 0.5f - part.y, -std::cos(angle)});
        },
        16);
}

TEST_F(SurfaceLayers, AnEquirectangularPictureCoversItsPartOfTheSphere) {
    start();
    auto layer =
        make_layer<XrCompositionLayerEquirect2KHR>(XR_TYPE_COMPOSITION_LAYER_EQUIRECT2_KHR, make_cells());
    layer.centralHorizontalAngle = 1.3f;
    layer.upperVerticalAngle = 0.5f;
    layer.lowerVerticalAngle = -0.3f;
    for (const float radius : {3.0f, 0.5f}) {
        layer.radius = radius;
        layer.pose = turned(-8.0f, {0.1f, -0.1f, 0.05f});
        show_opaque(layer);
        expect_cells(
            [&](vec2 part) {
                const float azimuth = 1.3f * (part.x - 0.5f), elevation = 0.5f - 0.8f * part.y;
                return placed(layer.pose,
                              radius * vec3(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                                            -std::cos(azimuth) * std::cos(elevation)));
            },
            12);
    }
    layer.radius = 0.0f;
    show_opaque(layer);
    EXPECT_EQ(shown(0), shown(1)) << "infinitely far";
    layer.centralHorizontalAngle = 2 * pi;
    layer.upperVerticalAngle = pi / 2;
    layer.lowerVerticalAngle = -pi / 2;
    show_opaque(layer);
    const Image all_round = shown(0);
    for (std::uint32_t y = 0; y < 256; ++y) EXPECT_EQ(pixel(all_round, 128, y)[2], 120) << "blue everywhere";
}

TEST_F(SurfaceLayers, EachEyeSeesWhatIsMeantForIt) {
    start();
    auto left = make_quad(make_plain({250, 0, 0, 255}), 4.0f, 1.0f), right = left;
    left.eyeVisibility = XR_EYE_VISIBILITY_LEFT;
    right.eyeVisibility = XR_EYE_VISIBILITY_RIGHT;
    right.subImage.swapchain = make_plain({0, 250, 0, 255});
    show_opaque(left, right);
    expect_uniform(shown(0), {250, 0, 0});
    expect_uniform(shown(1), {0, 250, 0});
}

TEST_F(SurfaceLayers, OnlyTheRectangleOfTheLayerOfTheArrayIsShown) {
    start();
    const XrSwapchain swapchain = make_picture({64, 64},
                                               {{{{0, 0}, {64, 64}}, {255, 255, 255, 255}, 0},
                                                {{{0, 0}, {64, 64}}, {255, 255, 255, 255}, 1},
                                                {{{0, 0}, {64, 64}}, {0, 0, 255, 255}, 2},
                                                {{{8, 24}, {20, 12}}, {10, 90, 30, 255}, 2}},
                                               VK_FORMAT_B8G8R8A8_SRGB, 3);
    auto quad = make_quad(swapchain, 1.0f, 2.0f);
    quad.pose.position.x = -0.0315f;  // where the left eye is
    quad.subImage = {swapchain, {{8, 24}, {20, 12}}, 2};
    show_opaque(quad);
    const Image image = shown(0);
    for (std::uint32_t y = 97; y < 159; ++y) {  // 96 and 159 are its edges
        for (std::uint32_t x = 97; x < 159; ++x)
            ASSERT_EQ(pixel(image, x, y), (Rgb{30, 90, 10})) << x << ' ' << y;
    }
}

TEST_F(SurfaceLayers, FineDetailIsAveraged) {
    start();
    std::vector<Part> stripes{{{{0, 0}, {64, 64}}, {0, 0, 0, 255}}};
    for (int x = 0; x < 64; x += 2) stripes.push_back({{{x, 0}, {1, 64}}, {255, 255, 255, 255}});
    // 64 texels on 16 pixels.
    show_opaque(make_quad(make_picture({64, 64}, stripes), 0.5f, 4.0f));
    const int grey = srgb_byte(0.5f);
    for (std::uint32_t x = 124; x < 134; ++x)
        expect_near(pixel(shown(0), x, 128), {grey, grey, grey}, "stripes", 3);
}

TEST_F(SurfaceLayers, ClientsThatMakeTheirOwnDeviceSeeTheSame) {
    start({}, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, VulkanEnable::First);
    show_opaque(make_quad(make_cells()));
    expect_cells([](vec2 part) { return vec3(part.x - 0.5f, 0.5f - part.y, -2.0f); }, 16);
}

}  // namespace
}  // namespace foveray::simulator_tests
