// FOVERAY_SIMULATOR_BACKGROUND: what is seen where the layers let the world through.
#include <cmath>

#include "base/headset_profile.h"
#include "tests/xr/simulator/composed.h"

namespace foveray::simulator_tests {
namespace {

constexpr auto opaque = XR_ENVIRONMENT_BLEND_MODE_OPAQUE, alpha_blend = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND,
               additive = XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;

class Backgrounds : public Composed {
  protected:
    XrCompositionLayerQuad veil() {  // a quarter opaque, dark
        auto quad = make_quad(make_plain({0, 0, 90, 64}), 8.0f, 1.0f);
        quad.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
        return quad;
    }
    /// Columns of equal width.
    std::string write_columns(const std::string& name, std::uint32_t width, std::uint32_t height,
                              const std::vector<Rgb>& colors) {
        Image image(width, height, 3);
        for (std::uint32_t y = 0; y < height; ++y) {
            for (std::uint32_t x = 0; x < width; ++x) {
                const Rgb& color = colors[x * colors.size() / width];
                for (std::size_t c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>(color[c]);
            }
        }
        write_png(folder_ / name, image);
        return folder_ / name;
    }
};

TEST_F(Backgrounds, AColourIsSeenThroughTheLayers) {
    start({{"BACKGROUND", "#C86432"}});
    show(alpha_blend);
    expect_uniform(shown(0), {200, 100, 50});
    show(alpha_blend, veil());
    const float open = 1 - 64.0f / 255;
    expect_uniform(shown(1),
                   {srgb_byte(open * linear_of(200)), srgb_byte(open * linear_of(100)),
                    srgb_byte(linear_of(90) + open * linear_of(50))},
                   1);
    show(opaque, veil());
    expect_uniform(shown(0), {0, 0, 90});
}

TEST_F(Backgrounds, AdditiveDisplaysAddIt) {
    HeadsetProfile profile = read_headset_profile("ci");
    profile.blend_modes.push_back(BlendMode::Additive);
    write_headset_profile(folder_ / "glasses.json", profile);
    start({{"BACKGROUND", "#C86432"}, {"PROFILE", folder_ / "glasses.json"}});
    show(additive, veil());
    expect_uniform(shown(0), {200, 100, srgb_byte(linear_of(90) + linear_of(50))}, 1);
}

TEST_F(Backgrounds, AnEnvironmentStandsStillInTheStage) {
    std::vector<Rgb> colors;
    for (int i = 0; i < 8; ++i) colors.push_back({30 * i, 250 - 30 * i, 40});
    Session script = make_session(10);
    script.head = {
        {0, {quat(1, 0, 0, 0), vec3(0, 1.6f, 0)}},
        {from_seconds(1.0 / 30), {glm::angleAxis(radians(180.0f), vec3(0, 1, 0)), vec3(3, 1.6f, 0)}}};
    write_session(folder_.path() / "s", script);
    start({{"BACKGROUND", write_columns("around.png", 256, 128, colors)}, {"SESSION", folder_.path() / "s"}});
    show(alpha_blend);
    // Columns are 45 degrees wide; -z is where the fourth meets the fifth.
    for (const std::uint32_t y : {20u, 128u, 230u}) {
        expect_near(pixel(shown(0), 60, y), colors[3], "left of the middle");
        expect_near(pixel(shown(1), 200, y), colors[4], "right of the middle");
    }
    show(alpha_blend);
    expect_near(pixel(shown(0), 60, 128), colors[7], "turned round: left of the back");
    expect_near(pixel(shown(0), 200, 128), colors[0], "turned round: right of the back");
    EXPECT_NE(pixel(shown(0), 126, 128), (Rgb{0, 0, 0})) << "no seam";
}

TEST_F(Backgrounds, UpIsTheEnvironmentsUpperEdge) {
    // Radiance: ahead and above 1/4, below 1, too small for run-length encoding.
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 1\n";
    for (const char* row : {"\x80\x80\x80\x7f", "\x80\x80\x80\x7f", "\x80\x80\x80\x81", "\x80\x80\x80\x81"})
        hdr += row;
    start({{"BACKGROUND", folder_.write("sky.hdr", hdr)}});
    show(alpha_blend);
    expect_near(pixel(shown(0), 128, 5), {srgb_byte(0.25f), srgb_byte(0.25f), srgb_byte(0.25f)}, "up");
    expect_near(pixel(shown(0), 128, 250), {255, 255, 255}, "down");
}

TEST_F(Backgrounds, ASequenceAdvancesWithTheFrames) {
    for (int i = 0; i < 3; ++i)
        write_columns("camera/" + std::to_string(i) + "_left.png", 40, 40, {{50 * i + 20, 10, 30}});
    write_columns("camera/5_right.png", 64, 16, {{1, 2, 3}});
    start({{"BACKGROUND", folder_ / "camera/*_left.png"}});
    for (const int i : {0, 1, 2, 0}) {
        show(alpha_blend);
        expect_uniform(shown(0), {50 * i + 20, 10, 30});
    }
    client_.reset();
    local_ = XR_NULL_HANDLE;
    frames_ = 0;
    start({{"BACKGROUND", folder_ / "camera"}});
    for (int i = 0; i < 4; ++i) show(alpha_blend);
    expect_uniform(shown(1), {1, 2, 3});
}

TEST_F(Backgrounds, PicturesFillTheEyeAndAreCutToItsShape) {
    write_columns("wide/a.png", 512, 256, {{200, 0, 0}, {0, 200, 0}, {0, 0, 200}, {200, 0, 0}});
    start({{"BACKGROUND", folder_ / "wide"}});
    show(alpha_blend);
    for (const std::uint32_t y : {0u, 128u, 255u}) {
        EXPECT_EQ(pixel(shown(0), 0, y), (Rgb{0, 200, 0}));
        EXPECT_EQ(pixel(shown(0), 127, y), (Rgb{0, 200, 0}));
        EXPECT_EQ(pixel(shown(0), 128, y), (Rgb{0, 0, 200}));
        EXPECT_EQ(pixel(shown(0), 255, y), (Rgb{0, 0, 200}));
    }
}

TEST_F(Backgrounds, APictureThatCannotBeReadFailsTheSession) {
    set_environment({{"BACKGROUND", folder_.write("no.png", "text")}, {"CAPTURE", captures()}});
    client_ = std::make_unique<SimulatorClient>();
    client_->vulkan = std::make_unique<VulkanClient>(client_->instance);
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &client_->vulkan->binding(), 0,
                                   SimulatorClient::system};
    EXPECT_EQ(xrCreateSession(client_->instance, &info, &client_->session), XR_ERROR_RUNTIME_FAILURE);
    write_columns("no.png", 4, 4, {{1, 2, 3}});
    EXPECT_EQ(xrCreateSession(client_->instance, &info, &client_->session), XR_SUCCESS) << "mended";
}

}  // namespace
}  // namespace foveray::simulator_tests
