// XR_MND_headless: sessions without graphics.
#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

using States = std::vector<XrSessionState>;

XrResult sync_nothing(XrSession session) {
    const XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 0, nullptr};
    return xrSyncActions(session, &info);
}

TEST(Headless, NeedsItsExtension) {
    set_environment({});
    SimulatorClient client({XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME});
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, nullptr, 0, client.system};
    XrSession session = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateSession(client.instance, &info, &session), XR_ERROR_GRAPHICS_DEVICE_INVALID);
}

TEST(Headless, IsFocusedAfterBeginAndEndsWithoutFrames) {
    set_environment({});
    SimulatorClient client(headless_extensions);
    client.create_headless_session();
    EXPECT_EQ(client.take_states(), (States{XR_SESSION_STATE_IDLE, XR_SESSION_STATE_READY}));
    client.begin_session(static_cast<XrViewConfigurationType>(0));
    EXPECT_EQ(client.take_states(),
              (States{XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_FOCUSED}));
    EXPECT_EQ(sync_nothing(client.session), XR_SUCCESS);
    ASSERT_XR_SUCCESS(xrRequestExitSession(client.session));
    ASSERT_XR_SUCCESS(xrEndSession(client.session));
    EXPECT_EQ(client.take_states(),
              (States{XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_STOPPING,
                      XR_SESSION_STATE_IDLE, XR_SESSION_STATE_EXITING}));
}

TEST(Headless, HasNoSwapchains) {
    set_environment({});
    SimulatorClient client(headless_extensions);
    client.create_headless_session();
    std::uint32_t count = 7;
    std::int64_t formats[4];
    ASSERT_XR_SUCCESS(xrEnumerateSwapchainFormats(client.session, 0, &count, nullptr));
    EXPECT_EQ(count, 0u);
    ASSERT_XR_SUCCESS(xrEnumerateSwapchainFormats(client.session, 4, &count, formats));
    EXPECT_EQ(count, 0u);
    XrSwapchainCreateInfo info{};
    info.type = XR_TYPE_SWAPCHAIN_CREATE_INFO;
    info.format = VK_FORMAT_R8G8B8A8_SRGB;
    info.sampleCount = info.width = info.height = info.faceCount = info.arraySize = info.mipCount = 1;
    XrSwapchain swapchain = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateSwapchain(client.session, &info, &swapchain), XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
}

TEST(Headless, MayHaveFramesButNothingToRender) {
    set_environment({});
    SimulatorClient client(headless_extensions);
    client.create_headless_session();
    client.begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    const XrFrameState first = client.empty_frame(), second = client.empty_frame();
    EXPECT_FALSE(first.shouldRender);
    EXPECT_EQ(second.predictedDisplayTime, first.predictedDisplayTime + first.predictedDisplayPeriod);
    EXPECT_EQ(sync_nothing(client.session), XR_SUCCESS);
    EXPECT_EQ(client.empty_frame().predictedDisplayTime,
              second.predictedDisplayTime + second.predictedDisplayPeriod)
        << "frames, not xrSyncActions, carry the time on once there are any";
}

TEST(Headless, LayersOfAFrameAreIgnored) {
    set_environment({});
    SimulatorClient client(headless_extensions);
    client.create_headless_session();
    client.begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    const XrFrameState state = client.wait_frame();
    ASSERT_XR_SUCCESS(xrBeginFrame(client.session, nullptr));
    XrCompositionLayerProjection nothing{};  // what a program without images can make
    nothing.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION;
    nothing.space = client.reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
    EXPECT_EQ(client.end_frame(state.predictedDisplayTime,
                               {reinterpret_cast<const XrCompositionLayerBaseHeader*>(&nothing)}),
              XR_SUCCESS);
}

TEST(Headless, SyncPlaysTheScriptWithoutFrames) {
    fakes::TemporaryFolder folder;
    write_session(folder.path() / "s", make_session(3));
    set_environment({{"SESSION", folder.path() / "s"}});
    SimulatorClient client(headless_extensions);
    client.create_headless_session();
    client.begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    EXPECT_EQ(sync_nothing(client.session), XR_SUCCESS);
    EXPECT_EQ(sync_nothing(client.session), XR_SUCCESS);
    client.take_states();
    EXPECT_EQ(sync_nothing(client.session), XR_SESSION_NOT_FOCUSED) << "the script has three frames";
    EXPECT_EQ(client.take_states(),
              (States{XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_STOPPING}));
}

}  // namespace
}  // namespace foveray::simulator_tests
