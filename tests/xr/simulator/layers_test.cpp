// Composition layers other than projection: what xrEndFrame accepts and refuses.
#include <cmath>

#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

class Layers : public testing::Test {
  protected:
    void start(const std::vector<const char*>& extensions = all_extensions) {
        set_environment({});
        client_ = std::make_unique<SimulatorClient>(extensions);
        client_->create_session();
        client_->begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
        space_ = client_->reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
        swapchain_ = create(VK_FORMAT_R8G8B8A8_SRGB, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 1, true);
    }

    XrSwapchain create(VkFormat format, XrSwapchainUsageFlags usage, std::uint32_t faces, bool release) {
        XrSwapchainCreateInfo info{};
        info.type = XR_TYPE_SWAPCHAIN_CREATE_INFO;
        info.usageFlags = usage;
        info.format = format;
        info.sampleCount = info.arraySize = info.mipCount = 1;
        info.faceCount = faces;
        info.width = info.height = 64;
        XrSwapchain swapchain = XR_NULL_HANDLE;
        EXPECT_EQ(xrCreateSwapchain(client_->session, &info, &swapchain), XR_SUCCESS);
        if (!release) return swapchain;
        std::uint32_t index = 0;
        const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
        EXPECT_EQ(xrAcquireSwapchainImage(swapchain, nullptr, &index), XR_SUCCESS);
        EXPECT_EQ(xrWaitSwapchainImage(swapchain, &wait), XR_SUCCESS);
        EXPECT_EQ(xrReleaseSwapchainImage(swapchain, nullptr), XR_SUCCESS);
        return swapchain;
    }

    /// Of a frame with that layer alone.
    XrResult submit(const void* layer) {
        const XrFrameState state = client_->wait_frame();
        EXPECT_TRUE(XR_SUCCEEDED(xrBeginFrame(client_->session, nullptr)));
        return client_->end_frame(state.predictedDisplayTime,
                                  {static_cast<const XrCompositionLayerBaseHeader*>(layer)});
    }

    /// A layer with its type, and what quads, cylinders and equirectangular layers have in common.
    template <typename Layer>
    Layer make(XrStructureType type) {
        Layer layer{};
        layer.type = type;
        layer.space = space_;
        layer.pose.orientation.w = 1.0f;
        layer.subImage = {swapchain_, {{0, 0}, {64, 64}}, 0};
        return layer;
    }
    XrCompositionLayerQuad quad() {
        auto layer = make<XrCompositionLayerQuad>(XR_TYPE_COMPOSITION_LAYER_QUAD);
        layer.size = {1.0f, 1.0f};
        return layer;
    }
    XrCompositionLayerCylinderKHR cylinder() {
        auto layer = make<XrCompositionLayerCylinderKHR>(XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR);
        layer.centralAngle = 1.0f;
        layer.aspectRatio = 1.0f;
        return layer;
    }
    XrCompositionLayerEquirect2KHR equirect() {
        auto layer = make<XrCompositionLayerEquirect2KHR>(XR_TYPE_COMPOSITION_LAYER_EQUIRECT2_KHR);
        layer.centralHorizontalAngle = 2.0f * pi;
        layer.upperVerticalAngle = pi / 2;
        layer.lowerVerticalAngle = -pi / 2;
        return layer;
    }

    template <typename Layer, typename Change>
    void expect(XrResult result, Layer layer, Change change, const char* what) {
        change(layer);
        EXPECT_EQ(submit(&layer), result) << what;
    }

    /// What is alike for all three.
    template <typename Layer>
    void expect_common_checks(const Layer& layer) {
        const auto accept = [&](auto change, const char* what) { expect(XR_SUCCESS, layer, change, what); };
        accept([](auto&) {}, "as it is");
        for (XrCompositionLayerFlags flags = 0; flags < 8; ++flags)
            accept([&](auto& l) { l.layerFlags = flags; }, "flags");
        for (const auto eye : {XR_EYE_VISIBILITY_LEFT, XR_EYE_VISIBILITY_RIGHT})
            accept([&](auto& l) { l.eyeVisibility = eye; }, "eyes");
        for (const auto type : {XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_STAGE})
            accept([&](auto& l) { l.space = client_->reference_space(type); }, "spaces");
        const XrBaseInStructure unknown{static_cast<XrStructureType>(0x7000'0000), nullptr};
        accept([&](auto& l) { l.next = &unknown; }, "unknown structures are ignored");
        const auto invalid = XR_ERROR_VALIDATION_FAILURE;
        expect(
            invalid, layer, [](auto& l) { l.layerFlags = 0x100; }, "unknown flag");
        expect(
            invalid, layer, [](auto& l) { l.eyeVisibility = XR_EYE_VISIBILITY_MAX_ENUM; }, "eyes");
        expect(
            invalid, layer, [](auto& l) { l.subImage.imageArrayIndex = 1; }, "array index");
        expect(
            XR_ERROR_POSE_INVALID, layer, [](auto& l) { l.pose.orientation.w = 0.98f; }, "2 % too short");
        expect(
            XR_ERROR_POSE_INVALID, layer, [](auto& l) { l.pose.position.y = INFINITY; }, "far away");
        expect(
            XR_ERROR_HANDLE_INVALID, layer, [](auto& l) { l.space = XR_NULL_HANDLE; }, "no space");
        expect(
            XR_ERROR_HANDLE_INVALID, layer, [](auto& l) { l.subImage.swapchain = XR_NULL_HANDLE; },
            "no swapchain");
        const auto outside = XR_ERROR_SWAPCHAIN_RECT_INVALID;
        expect(
            outside, layer,
            [](auto& l) {
                l.subImage.imageRect.offset = {-1, -1};
            },
            "negative");
        expect(
            outside, layer,
            [](auto& l) {
                l.subImage.imageRect.offset = {1, 1};
            },
            "beyond the edge");
        expect(
            outside, layer, [](auto& l) { l.subImage.imageRect.offset.x = INT32_MAX; }, "overflow");
        const XrSwapchain fresh =
            create(VK_FORMAT_R8G8B8A8_SRGB, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 1, false);
        expect(
            XR_ERROR_LAYER_INVALID, layer, [&](auto& l) { l.subImage.swapchain = fresh; }, "not released");
        const XrSwapchain cube =
            create(VK_FORMAT_R8G8B8A8_SRGB, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 6, true);
        expect(
            invalid, layer, [&](auto& l) { l.subImage.swapchain = cube; }, "a cube");
        const XrSwapchain depth =
            create(VK_FORMAT_D32_SFLOAT, XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 1, true);
        expect(
            XR_ERROR_LAYER_INVALID, layer, [&](auto& l) { l.subImage.swapchain = depth; }, "depth");
        accept([](auto&) {}, "after all that");
    }

    std::unique_ptr<SimulatorClient> client_;
    XrSpace space_ = XR_NULL_HANDLE;
    XrSwapchain swapchain_ = XR_NULL_HANDLE;
};

TEST_F(Layers, Quads) {
    start();
    expect_common_checks(quad());
    expect(
        XR_SUCCESS, quad(),
        [](auto& l) {
            l.size = {0, 0};
        },
        "no size");
    expect(
        XR_ERROR_VALIDATION_FAILURE, quad(), [](auto& l) { l.size.width = NAN; }, "NaN");
}

TEST_F(Layers, Cylinders) {
    start();
    expect_common_checks(cylinder());
    for (const float radius : {0.0f, 1.0f, INFINITY})
        expect(
            XR_SUCCESS, cylinder(), [&](auto& l) { l.radius = radius; }, "radius");
    const auto invalid = XR_ERROR_VALIDATION_FAILURE;
    for (const float radius : {-1.0f, NAN})
        expect(
            invalid, cylinder(), [&](auto& l) { l.radius = radius; }, "radius");
    for (const float angle : {-0.1f, 7.0f, NAN})
        expect(
            invalid, cylinder(), [&](auto& l) { l.centralAngle = angle; }, "angle");
    for (const float ratio : {0.0f, -1.0f, NAN, INFINITY})
        expect(
            invalid, cylinder(), [&](auto& l) { l.aspectRatio = ratio; }, "aspect ratio");
}

TEST_F(Layers, EquirectangularOnes) {
    start();
    expect_common_checks(equirect());
    for (const float radius : {0.0f, 2.0f, INFINITY})
        expect(
            XR_SUCCESS, equirect(), [&](auto& l) { l.radius = radius; }, "radius");
    const auto invalid = XR_ERROR_VALIDATION_FAILURE;
    for (const float radius : {-1.0f, NAN})
        expect(
            invalid, equirect(), [&](auto& l) { l.radius = radius; }, "radius");
    for (const float angle : {-0.1f, 7.0f, NAN})
        expect(
            invalid, equirect(), [&](auto& l) { l.centralHorizontalAngle = angle; }, "angle");
    expect(
        invalid, equirect(), [](auto& l) { l.upperVerticalAngle = NAN; }, "angle");
}

TEST_F(Layers, ExtensionsMustBeEnabled) {
    start({XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME});
    const auto c = cylinder();
    const auto e = equirect();
    EXPECT_EQ(submit(&c), XR_ERROR_LAYER_INVALID);
    EXPECT_EQ(submit(&e), XR_ERROR_LAYER_INVALID);
    const XrCompositionLayerBaseHeader unknown{XR_TYPE_FRAME_STATE, nullptr, 0, space_};
    EXPECT_EQ(submit(&unknown), XR_ERROR_LAYER_INVALID);
}

TEST_F(Layers, SixteenAreTheLeastThatMustBeAccepted) {
    start();
    const auto q = quad();
    const auto count = [&](std::size_t n) {
        const XrFrameState state = client_->wait_frame();
        EXPECT_TRUE(XR_SUCCEEDED(xrBeginFrame(client_->session, nullptr)));
        return client_->end_frame(state.predictedDisplayTime,
                                  {n, reinterpret_cast<const XrCompositionLayerBaseHeader*>(&q)});
    };
    EXPECT_EQ(count(XR_MIN_COMPOSITION_LAYERS_SUPPORTED), XR_SUCCESS);
    EXPECT_EQ(count(XR_MIN_COMPOSITION_LAYERS_SUPPORTED + 1), XR_ERROR_LAYER_LIMIT_EXCEEDED);
}

}  // namespace
}  // namespace foveray::simulator_tests
