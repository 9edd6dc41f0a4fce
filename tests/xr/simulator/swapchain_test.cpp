// Swapchains: formats, the acquire-wait-release machine, layer checks.
#include <algorithm>

#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

/// Before any member of a fixture connects to the runtime.
struct PlainEnvironment {
    PlainEnvironment() { set_environment({}); }
};

class Swapchains : PlainEnvironment, public testing::Test {
  protected:
    Swapchains() {
        client_.create_session();
        client_.begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    }

    static XrSwapchainCreateInfo info() {
        XrSwapchainCreateInfo info{};
        info.type = XR_TYPE_SWAPCHAIN_CREATE_INFO;
        info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
        info.format = VK_FORMAT_R8G8B8A8_SRGB;
        info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
        info.width = 64;
        info.height = 32;
        return info;
    }

    XrSwapchain create(const XrSwapchainCreateInfo& create_info) {
        XrSwapchain swapchain = XR_NULL_HANDLE;
        EXPECT_EQ(xrCreateSwapchain(client_.session, &create_info, &swapchain), XR_SUCCESS);
        return swapchain;
    }

    static XrResult acquire(XrSwapchain swapchain, std::uint32_t* index = nullptr) {
        std::uint32_t ignored = 0;
        return xrAcquireSwapchainImage(swapchain, nullptr, index ? index : &ignored);
    }
    static XrResult wait(XrSwapchain swapchain) {
        const XrSwapchainImageWaitInfo info{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
        return xrWaitSwapchainImage(swapchain, &info);
    }
    static XrResult release(XrSwapchain swapchain) { return xrReleaseSwapchainImage(swapchain, nullptr); }

    SimulatorClient client_;
};

TEST_F(Swapchains, FormatsBeginWithSrgbAndIncludeDepth) {
    std::uint32_t count = 0;
    ASSERT_XR_SUCCESS(xrEnumerateSwapchainFormats(client_.session, 0, &count, nullptr));
    std::vector<std::int64_t> formats(count);
    ASSERT_XR_SUCCESS(xrEnumerateSwapchainFormats(client_.session, count, &count, formats.data()));
    EXPECT_EQ(formats.front(), VK_FORMAT_R8G8B8A8_SRGB);
    EXPECT_EQ(std::ranges::count(formats, VK_FORMAT_D32_SFLOAT), 1);
    for (const std::int64_t format : formats) {
        XrSwapchainCreateInfo create_info = info();
        create_info.format = format;
        const bool depth = format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM;
        create_info.usageFlags =
            depth ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                  : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT;
        const XrSwapchain swapchain = create(create_info);
        EXPECT_EQ(acquire(swapchain), XR_SUCCESS) << format;
        EXPECT_EQ(xrDestroySwapchain(swapchain), XR_SUCCESS);
    }
}

TEST_F(Swapchains, CreationVerifiesItsArguments) {
    const auto expect = [&](XrResult result, auto change) {
        XrSwapchainCreateInfo create_info = info();
        change(create_info);
        XrSwapchain swapchain = XR_NULL_HANDLE;
        EXPECT_EQ(xrCreateSwapchain(client_.session, &create_info, &swapchain), result);
    };
    expect(XR_ERROR_VALIDATION_FAILURE, [](auto& i) { i.type = XR_TYPE_FRAME_STATE; });
    expect(XR_ERROR_VALIDATION_FAILURE, [](auto& i) { i.width = 0; });
    expect(XR_ERROR_VALIDATION_FAILURE, [](auto& i) { i.faceCount = 3; });
    expect(XR_ERROR_VALIDATION_FAILURE, [](auto& i) { i.usageFlags = 1ull << 40; });
    expect(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, [](auto& i) { i.format = VK_FORMAT_R64_UINT; });
    expect(XR_ERROR_FEATURE_UNSUPPORTED, [](auto& i) { i.width = 100'000; });
    expect(XR_ERROR_FEATURE_UNSUPPORTED, [](auto& i) { i.sampleCount = 4; });
    expect(XR_ERROR_FEATURE_UNSUPPORTED,
           [](auto& i) { i.createFlags = XR_SWAPCHAIN_CREATE_PROTECTED_CONTENT_BIT; });
}

TEST_F(Swapchains, ImagesAreAcquiredWaitedForAndReleasedInTurn) {
    const XrSwapchain swapchain = create(info());
    std::uint32_t count = 0;
    ASSERT_XR_SUCCESS(xrEnumerateSwapchainImages(swapchain, 0, &count, nullptr));
    ASSERT_EQ(count, 3u);
    EXPECT_EQ(wait(swapchain), XR_ERROR_CALL_ORDER_INVALID) << "nothing acquired";
    EXPECT_EQ(release(swapchain), XR_ERROR_CALL_ORDER_INVALID);
    std::uint32_t a = 9, b = 9, c = 9;
    EXPECT_EQ(acquire(swapchain, &a), XR_SUCCESS);
    EXPECT_EQ(release(swapchain), XR_ERROR_CALL_ORDER_INVALID) << "not waited for";
    EXPECT_EQ(acquire(swapchain, &b), XR_SUCCESS);
    EXPECT_EQ(acquire(swapchain, &c), XR_SUCCESS);
    EXPECT_EQ(std::set({a, b, c}), (std::set<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(acquire(swapchain), XR_ERROR_CALL_ORDER_INVALID) << "all are out";
    EXPECT_EQ(wait(swapchain), XR_SUCCESS);
    EXPECT_EQ(wait(swapchain), XR_ERROR_CALL_ORDER_INVALID) << "release that one first";
    EXPECT_EQ(release(swapchain), XR_SUCCESS);
    EXPECT_EQ(release(swapchain), XR_ERROR_CALL_ORDER_INVALID);
    std::uint32_t again = 9;
    EXPECT_EQ(acquire(swapchain, &again), XR_SUCCESS);
    EXPECT_EQ(again, a);
}

TEST_F(Swapchains, StaticImagesAreAcquiredOnce) {
    XrSwapchainCreateInfo create_info = info();
    create_info.createFlags = XR_SWAPCHAIN_CREATE_STATIC_IMAGE_BIT;
    const XrSwapchain swapchain = create(create_info);
    EXPECT_EQ(acquire(swapchain), XR_SUCCESS);
    EXPECT_EQ(wait(swapchain), XR_SUCCESS);
    EXPECT_EQ(release(swapchain), XR_SUCCESS);
    EXPECT_EQ(acquire(swapchain), XR_ERROR_CALL_ORDER_INVALID);
}

TEST_F(Swapchains, LayersAreVerified) {
    const XrSwapchain swapchain = create(info());
    XrCompositionLayerProjectionView view{};
    view.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW;
    view.pose.orientation.w = 1.0f;
    view.fov = {-0.5f, 0.5f, 0.5f, -0.5f};
    view.subImage = {swapchain, {{0, 0}, {64, 32}}, 0};
    const XrSpace space = client_.reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    std::array<XrCompositionLayerProjectionView, 2> views{view, view};
    XrCompositionLayerProjection layer{
        XR_TYPE_COMPOSITION_LAYER_PROJECTION, nullptr, 0, space, 2, views.data()};

    const XrFrameState state = client_.wait_frame();
    ASSERT_XR_SUCCESS(xrBeginFrame(client_.session, nullptr));
    const auto submit = [&](const void* header) {
        return client_.end_frame(state.predictedDisplayTime,
                                 {static_cast<const XrCompositionLayerBaseHeader*>(header)});
    };
    EXPECT_EQ(submit(nullptr), XR_ERROR_LAYER_INVALID);
    EXPECT_EQ(submit(&layer), XR_ERROR_LAYER_INVALID) << "no image was released";
    acquire(swapchain), wait(swapchain), release(swapchain);

    const auto expect = [&](XrResult result, auto change) {
        const auto kept = views;
        change(views[1]);
        EXPECT_EQ(submit(&layer), result);
        views = kept;
    };
    expect(XR_ERROR_SWAPCHAIN_RECT_INVALID, [](auto& v) { v.subImage.imageRect.extent.width = 65; });
    expect(XR_ERROR_SWAPCHAIN_RECT_INVALID, [](auto& v) { v.subImage.imageRect.offset.x = -1; });
    expect(XR_ERROR_SWAPCHAIN_RECT_INVALID, [](auto& v) { v.subImage.imageRect.extent.height = 0; });
    expect(XR_ERROR_VALIDATION_FAILURE, [](auto& v) { v.subImage.imageArrayIndex = 1; });
    expect(XR_ERROR_POSE_INVALID, [](auto& v) { v.pose.orientation.w = 0.0f; });
    expect(XR_ERROR_POSE_INVALID, [](auto& v) { v.pose.position.x = NAN; });
    expect(XR_ERROR_VALIDATION_FAILURE, [](auto& v) { v.fov.angleLeft = 2.0f; });
    expect(XR_ERROR_VALIDATION_FAILURE, [](auto& v) { v.type = XR_TYPE_VIEW; });
    layer.viewCount = 1;
    EXPECT_EQ(submit(&layer), XR_ERROR_VALIDATION_FAILURE);
    layer.viewCount = 2;
    const std::vector<const XrCompositionLayerBaseHeader*> too_many(
        17, reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer));
    EXPECT_EQ(client_.end_frame(state.predictedDisplayTime, too_many), XR_ERROR_LAYER_LIMIT_EXCEEDED);

    XrCompositionLayerDepthInfoKHR depth{};
    depth.type = XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR;
    depth.subImage = view.subImage;
    depth.maxDepth = 1.0f;
    depth.nearZ = 0.1f;
    depth.farZ = 100.0f;
    expect(XR_ERROR_VALIDATION_FAILURE, [&](auto& v) { v.next = &depth; });  // a colour image
    XrSwapchainCreateInfo depth_info = info();
    depth_info.format = VK_FORMAT_D32_SFLOAT;
    depth_info.usageFlags = XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    depth.subImage.swapchain = create(depth_info);
    acquire(depth.subImage.swapchain), wait(depth.subImage.swapchain), release(depth.subImage.swapchain);
    views[1].next = &depth;
    EXPECT_EQ(submit(&layer), XR_SUCCESS);
}

}  // namespace
}  // namespace foveray::simulator_tests
