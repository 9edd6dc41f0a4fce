// What the headset shows, as files.
#include <cmath>
#include <fstream>

#include "tests/xr/simulator/composed.h"

namespace foveray::simulator_tests {
namespace {

class Captures : public testing::Test {
  protected:
    void start(const std::map<std::string, std::string>& variables, XrViewConfigurationType type) {
        auto all = variables;
        all["CAPTURE"] = folder_.path() / "shown";
        set_environment(all);
        client_ = std::make_unique<SimulatorClient>();
        client_->create_session();
        client_->begin_session(type);
        type_ = type;
    }

    Image image(const std::string& name) const { return read_image(folder_.path() / "shown" / name, 3); }
    bool exists(const std::string& name) const {
        return std::filesystem::exists(folder_.path() / "shown" / name);
    }

    /// One swapchain for all views: a layer each, filled with grey but for the view's own rectangle at (16,
    /// 8).
    void make_swapchain(VkFormat format, std::uint32_t width, std::uint32_t height, std::uint32_t layers) {
        XrSwapchainCreateInfo info{};
        info.type = XR_TYPE_SWAPCHAIN_CREATE_INFO;
        info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
        info.format = format;
        info.sampleCount = info.faceCount = info.mipCount = 1;
        info.arraySize = layers;
        info.width = width;
        info.height = height;
        ASSERT_XR_SUCCESS(xrCreateSwapchain(client_->session, &info, &swapchain_));
        size_ = {width, height};
    }

    struct Part {
        VkExtent2D size;
        Color color;
    };

    XrResult show(const std::vector<Part>& parts, XrCompositionLayerFlags flags = 0,
                  XrEnvironmentBlendMode mode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE) {
        const XrFrameState state = client_->wait_frame();
        EXPECT_EQ(xrBeginFrame(client_->session, nullptr), XR_SUCCESS);
        const XrSpace stage = client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
        const auto located = client_->locate_views(stage, state.predictedDisplayTime, type_, false);
        EXPECT_EQ(located.size(), parts.size());

        std::uint32_t index = 0, count = 0;
        EXPECT_EQ(xrAcquireSwapchainImage(swapchain_, nullptr, &index), XR_SUCCESS);
        const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
        EXPECT_EQ(xrWaitSwapchainImage(swapchain_, &wait), XR_SUCCESS);
        std::vector<XrSwapchainImageVulkanKHR> images(
            3, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR, nullptr, VK_NULL_HANDLE});
        EXPECT_EQ(xrEnumerateSwapchainImages(swapchain_, 3, &count,
                                             reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
                  XR_SUCCESS);
        std::vector<XrCompositionLayerProjectionView> views(parts.size());
        for (std::uint32_t i = 0; i < parts.size(); ++i) {
            const auto& [size, color] = parts[i];
            client_->vulkan->fill(images[index].image, i, {{0, 0}, size_}, {99, 99, 99, 99});
            client_->vulkan->fill(images[index].image, i, {{16, 8}, size}, color);
            views[i].type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW;
            views[i].pose = located[i].pose;
            views[i].fov = located[i].fov;
            views[i].subImage = {
                swapchain_,
                {{16, 8}, {static_cast<std::int32_t>(size.width), static_cast<std::int32_t>(size.height)}},
                i};
        }
        EXPECT_EQ(xrReleaseSwapchainImage(swapchain_, nullptr), XR_SUCCESS);
        const XrCompositionLayerProjection layer{
            XR_TYPE_COMPOSITION_LAYER_PROJECTION,     nullptr,     flags, stage,
            static_cast<std::uint32_t>(views.size()), views.data()};
        return client_->end_frame(state.predictedDisplayTime,
                                  {reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer)}, mode);
    }

    fakes::TemporaryFolder folder_;
    std::unique_ptr<SimulatorClient> client_;
    XrViewConfigurationType type_ = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    XrSwapchain swapchain_ = XR_NULL_HANDLE;
    VkExtent2D size_{};
};

TEST_F(Captures, ViewsAreExactAndTheFocusLiesInTheMergedPicture) {
    start({}, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO);
    make_swapchain(VK_FORMAT_R8G8B8A8_SRGB, 300, 280, 4);
    const VkExtent2D context{256, 256}, focus{192, 144};
    ASSERT_XR_SUCCESS(show({{context, {200, 10, 20, 255}},
                            {context, {30, 150, 40, 255}},
                            {focus, {5, 60, 250, 255}},
                            {focus, {128, 127, 1, 0}}}));
    expect_uniform(image("frame_00000_view0.png"), {200, 10, 20});
    expect_uniform(image("frame_00000_view1.png"), {30, 150, 40});
    expect_uniform(image("frame_00000_view2.png"), {5, 60, 250});
    expect_uniform(image("frame_00000_view3.png"), {128, 127, 1});
    EXPECT_EQ(image("frame_00000_view0.png").width, 256u);
    EXPECT_EQ(image("frame_00000_view2.png").height, 144u);

    // 144 pixels over tan 15 degrees, the denser axis, stretched to tan 45 degrees.
    const Image left = image("frame_00000_left.png"), right = image("frame_00000_right.png");
    EXPECT_NEAR(left.width, 144 / std::tan(radians(15.0f)), 2.0);
    EXPECT_EQ(left.height, left.width) << "square as the context";
    EXPECT_EQ(left.width % 2, 0u);
    EXPECT_EQ(pixel(left, left.width / 2, left.height / 2), (Rgb{5, 60, 250}));
    EXPECT_EQ(pixel(right, right.width / 2, right.height / 2), (Rgb{128, 127, 1}));
    const auto column = [&](float degrees_off) {
        return static_cast<std::uint32_t>((1.0f + std::tan(radians(degrees_off))) / 2 *
                                          static_cast<float>(left.width));
    };
    EXPECT_EQ(pixel(left, column(15.0f), left.height / 2), (Rgb{5, 60, 250})) << "inside the soft border";
    EXPECT_EQ(pixel(left, column(-15.0f), left.height / 2), (Rgb{5, 60, 250}));
    EXPECT_EQ(pixel(left, column(20.5f), left.height / 2), (Rgb{200, 10, 20})) << "outside the focus";
    EXPECT_EQ(pixel(left, left.width / 2, column(15.5f)), (Rgb{200, 10, 20}));
    const Rgb border = pixel(left, column(18.5f), left.height / 2);
    EXPECT_GT(border[0], 5);
    EXPECT_LT(border[0], 200);
    EXPECT_EQ(pixel(left, 0, 0), (Rgb{200, 10, 20}));
}

TEST_F(Captures, StereoIsMergedToItself) {
    start({{"PROFILE", "ci-stereo"}}, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    make_swapchain(VK_FORMAT_B8G8R8A8_SRGB, 260, 270, 2);
    ASSERT_XR_SUCCESS(show({{{240, 256}, {20, 10, 200, 255}}, {{240, 256}, {1, 2, 3, 255}}}));
    expect_uniform(image("frame_00000_view0.png"), {200, 10, 20});
    expect_uniform(image("frame_00000_left.png"), {200, 10, 20});
    expect_uniform(image("frame_00000_right.png"), {3, 2, 1});
    EXPECT_EQ(image("frame_00000_left.png").width, 240u);
}

TEST_F(Captures, UnormImagesHoldLinearLight) {
    start({{"PROFILE", "ci-stereo"}}, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    make_swapchain(VK_FORMAT_R8G8B8A8_UNORM, 64, 64, 2);
    ASSERT_XR_SUCCESS(show({{{32, 32}, {128, 0, 255, 255}}, {{32, 32}, {0, 0, 0, 255}}}));
    const int encoded = static_cast<int>(std::lround(255.0f * srgb_from_linear(128.0f / 255.0f)));
    expect_uniform(image("frame_00000_left.png"), {encoded, 0, 255});
}

TEST_F(Captures, AlphaIsShownOverBlack) {
    start({{"PROFILE", "ci-stereo"}}, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    make_swapchain(VK_FORMAT_R8G8B8A8_SRGB, 64, 64, 2);
    const std::vector<Part> parts{{{32, 32}, {200, 100, 50, 128}}, {{32, 32}, {0, 0, 0, 0}}};
    const auto alpha_blend = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
    ASSERT_XR_SUCCESS(show(parts, XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT, alpha_blend));
    expect_uniform(image("frame_00000_left.png"), {200, 100, 50});
    expect_uniform(image("frame_00000_right.png"), {0, 0, 0});
    ASSERT_XR_SUCCESS(show(
        parts,
        XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT | XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT,
        alpha_blend));
    const auto dimmed = [](float byte) {
        const float linear = linear_from_srgb(byte / 255.0f) * 128.0f / 255.0f;
        return static_cast<int>(std::lround(255.0f * srgb_from_linear(linear)));
    };
    const Rgb shown = pixel(image("frame_00001_left.png"), 100, 100);
    EXPECT_NEAR(shown[0], dimmed(200), 1);
    EXPECT_NEAR(shown[1], dimmed(100), 1);
    EXPECT_NEAR(shown[2], dimmed(50), 1);
}

TEST_F(Captures, OnlyTheFramesAskedForAndBlackWithoutLayers) {
    start({{"CAPTURE_FRAMES", "1:2"}}, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO);
    for (int i = 0; i < 3; ++i) client_->empty_frame();
    EXPECT_FALSE(exists("frame_00000_left.png"));
    EXPECT_FALSE(exists("frame_00002_left.png"));
    EXPECT_FALSE(exists("frame_00001_view0.png")) << "no view was submitted";
    expect_uniform(image("frame_00001_left.png"), {0, 0, 0});
    expect_uniform(image("frame_00001_right.png"), {0, 0, 0});
}

TEST_F(Captures, RawFilesHoldRowsOfFourBytes) {
    start({{"CAPTURE_FORMAT", "raw"}, {"PROFILE", "ci-stereo"}}, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    make_swapchain(VK_FORMAT_B8G8R8A8_SRGB, 260, 270, 2);
    ASSERT_XR_SUCCESS(show({{{240, 256}, {20, 10, 200, 7}}, {{12, 34}, {1, 2, 3, 255}}}));
    const auto bytes = [&](const std::string& name) {
        std::ifstream in(folder_.path() / "shown" / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    const auto repeated = [](std::size_t count, Color color) {
        std::string text;
        for (std::size_t i = 0; i < count; ++i) text.append(reinterpret_cast<const char*>(color.data()), 4);
        return text;
    };
    EXPECT_EQ(bytes("frame_00000_left_240x256.rgba"), repeated(240 * 256, {200, 10, 20, 255}));
    EXPECT_EQ(bytes("frame_00000_view0_240x256.rgba"), repeated(240 * 256, {200, 10, 20, 7}));
    EXPECT_EQ(bytes("frame_00000_view1_12x34.rgba"), repeated(12 * 34, {3, 2, 1, 255}));
    EXPECT_FALSE(exists("frame_00000_left.png"));
}

}  // namespace
}  // namespace foveray::simulator_tests
