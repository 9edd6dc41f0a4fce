// faults.csv: what happens to the wearer, the trackers, the form factor, the compositor and swapchains.
#include "tests/xr/simulator/faults_file.h"

namespace foveray::simulator_tests {
namespace {

using States = std::vector<XrSessionState>;
constexpr auto synchronized = XR_SESSION_STATE_SYNCHRONIZED, visible = XR_SESSION_STATE_VISIBLE,
               focused = XR_SESSION_STATE_FOCUSED;
constexpr XrSpaceLocationFlags orientation_valid = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT,
                               position_valid = XR_SPACE_LOCATION_POSITION_VALID_BIT,
                               orientation_tracked = XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT,
                               position_tracked = XR_SPACE_LOCATION_POSITION_TRACKED_BIT,
                               all = orientation_valid | position_valid | orientation_tracked |
                                     position_tracked;

TEST(Faults, AnAbsentUserSeesNothing) {
    const FaultsFile file("1,user_absent,\n2,focus_lost,\n3,user_present,\n4,focus_gained,\n");
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    client.empty_frame();
    client.take_states();
    const std::pair<States, bool> expected[] = {
        {{visible, synchronized}, false}, {{}, false}, {{visible}, true}, {{focused}, true}};
    for (const auto& [states, should_render] : expected) {
        EXPECT_EQ(client.empty_frame().shouldRender, should_render);
        EXPECT_EQ(client.take_states(), states);
    }
}

TEST(Faults, TimesHaveUnits) {
    const FaultsFile file("60ms,visibility_lost,\n0.1s,visibility_gained,\n");
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    std::vector<bool> rendered;
    for (int i = 0; i < 5; ++i) rendered.push_back(client.empty_frame().shouldRender);
    EXPECT_EQ(rendered, (std::vector{true, true, false, true, true})) << "frame 2 is at 67 ms, 3 at 100 ms";
}

TEST(Faults, TrackingIsLostInParts) {
    fakes::TemporaryFolder folder;
    Session session = make_session(100);
    for (int i = 0; i <= 10; ++i) {  // a metre a second to the right, turning left
        session.head.push_back({from_seconds(i / 30.0),
                                {glm::angleAxis(0.1f * static_cast<float>(i), vec3(0.0f, 1.0f, 0.0f)),
                                 vec3(static_cast<float>(i) / 30.0f, 1.6f, 0.0f)}});
    }
    write_session(folder.path() / "s", session);
    const FaultsFile file(
        "2,position_tracking_lost,\n4,position_tracking_gained,\n4,orientation_tracking_lost,\n"
        "6,orientation_tracking_gained,\n6,head_tracking_lost,\n7,head_tracking_gained,\n",
        {{"SESSION", folder.path() / "s"}});
    SimulatorClient client(headless_extensions);
    begin_headless(client);  // plays frame 0
    const XrSpace head = client.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW),
                  stage = client.reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    const struct {
        XrSpaceLocationFlags flags;
        float x, yaw;  // where valid: frames of the head's path
    } expected[] = {{all, 1, 1},
                    {all & ~position_tracked, 2, 2},
                    {all & ~position_tracked, 2, 3},
                    {all & ~orientation_tracked, 4, 4},
                    {all & ~orientation_tracked, 5, 4},
                    {0, 0, 0},
                    {all, 7, 7}};
    for (const auto& [flags, x, yaw] : expected) {
        const XrTime time = client.empty_frame().predictedDisplayTime;
        const XrSpaceLocation found = client.locate(head, stage, time);
        EXPECT_EQ(found.locationFlags, flags) << x;
        EXPECT_NEAR(found.pose.position.x, x / 30.0f, 1e-5f);
        EXPECT_NEAR(2.0f * std::asin(found.pose.orientation.y), 0.1f * yaw, 1e-4f);
        XrViewStateFlags view_flags = 0;
        client.locate_views(stage, time, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, false, &view_flags);
        EXPECT_EQ(view_flags, flags) << x;
    }
}

TEST(Faults, GazeIsLostAndFocusViewsStay) {
    fakes::TemporaryFolder folder;
    Session session = make_session(100);
    for (int i = 0; i < 10; ++i) {
        GazeSample sample;
        sample.time = from_seconds(i / 30.0);
        sample.valid = true;
        sample.direction = glm::normalize(vec3(0.05f * static_cast<float>(i), 0.0f, -1.0f));
        session.gaze.push_back(sample);
    }
    write_session(folder.path() / "s", session);
    const FaultsFile file("2,gaze_tracking_lost,\n4,gaze_tracking_gained,\n",
                          {{"SESSION", folder.path() / "s"}});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    const XrSpace gaze = client.reference_space(XR_REFERENCE_SPACE_TYPE_COMBINED_EYE_VARJO),
                  head = client.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    std::vector<XrQuaternionf> seen;
    for (int i = 0; i < 5; ++i) {
        const XrTime time = client.empty_frame().predictedDisplayTime;
        const XrSpaceLocation found = client.locate(gaze, head, time);
        EXPECT_EQ(found.locationFlags, all) << "the last valid gaze is held";
        seen.push_back(found.pose.orientation);
    }
    EXPECT_NE(seen[1].y, seen[2].y);
    EXPECT_EQ(seen[2].y, seen[3].y);
    EXPECT_NE(seen[3].y, seen[4].y);
}

TEST(Faults, TheFormFactorComesBack) {
    const FaultsFile file("start,form_factor_lost,\n3,form_factor_gained,\n");
    SimulatorClient client(headless_extensions);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(try_get_system(client.instance), XR_ERROR_FORM_FACTOR_UNAVAILABLE) << i;
    EXPECT_EQ(try_get_system(client.instance), XR_SUCCESS) << "frame 3";
    EXPECT_EQ(try_get_system(client.instance), XR_SUCCESS);
}

TEST(Faults, ASlowCompositorSkipsDisplayPeriods) {
    const FaultsFile file("2,slow_compositor,70\n4,slow_compositor,0\n");  // 33.3 ms a frame
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    const XrTime first = client.empty_frame().predictedDisplayTime;
    const XrDuration period = 33'333'334;
    const std::pair<int, int> expected[] = {{1, 1}, {2, 1}, {5, 3}, {6, 1}, {7, 1}};  // frame, periods
    for (const auto& [frame, periods] : expected) {
        const XrFrameState state = client.empty_frame();
        EXPECT_EQ(state.predictedDisplayTime - first, frame * period);
        EXPECT_EQ(state.predictedDisplayPeriod, periods * period);
    }
}

TEST(Faults, SwapchainWaitsRunOutOfTime) {
    const FaultsFile file("start,swapchain_timeout,2\n");
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    XrSwapchainCreateInfo info{};
    info.type = XR_TYPE_SWAPCHAIN_CREATE_INFO;
    info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
    info.format = VK_FORMAT_R8G8B8A8_SRGB;
    info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
    info.width = info.height = 16;
    XrSwapchain swapchain = XR_NULL_HANDLE;
    ASSERT_XR_SUCCESS(xrCreateSwapchain(client.session, &info, &swapchain));
    std::uint32_t image = 0;
    ASSERT_XR_SUCCESS(xrAcquireSwapchainImage(swapchain, nullptr, &image));
    const XrSwapchainImageWaitInfo brief{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, 1'000'000};
    const XrSwapchainImageWaitInfo forever{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
    EXPECT_EQ(xrWaitSwapchainImage(swapchain, &brief), XR_TIMEOUT_EXPIRED);
    EXPECT_EQ(xrReleaseSwapchainImage(swapchain, nullptr), XR_ERROR_CALL_ORDER_INVALID) << "not waited for";
    EXPECT_EQ(xrWaitSwapchainImage(swapchain, &brief), XR_TIMEOUT_EXPIRED);
    EXPECT_EQ(xrWaitSwapchainImage(swapchain, &brief), XR_SUCCESS);
    ASSERT_XR_SUCCESS(xrReleaseSwapchainImage(swapchain, nullptr));
    ASSERT_XR_SUCCESS(xrAcquireSwapchainImage(swapchain, nullptr, &image));
    EXPECT_EQ(xrWaitSwapchainImage(swapchain, &forever), XR_SUCCESS);
}

}  // namespace
}  // namespace foveray::simulator_tests
