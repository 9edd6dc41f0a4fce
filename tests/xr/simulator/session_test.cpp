// States, the frame loop, virtual time and the script's end.
#include <thread>

#include "tests/fakes/temporary_folder.h"
#include "tests/xr/simulator/simulator_client.h"

namespace foveray::simulator_tests {
namespace {

using States = std::vector<XrSessionState>;
constexpr auto idle = XR_SESSION_STATE_IDLE, ready = XR_SESSION_STATE_READY,
               synchronized = XR_SESSION_STATE_SYNCHRONIZED, visible = XR_SESSION_STATE_VISIBLE,
               focused = XR_SESSION_STATE_FOCUSED, stopping = XR_SESSION_STATE_STOPPING,
               exiting = XR_SESSION_STATE_EXITING;

TEST(SessionStates, FromIdleToFocusedToExit) {
    set_environment({});
    SimulatorClient client;
    client.create_session();
    EXPECT_EQ(client.take_states(), (States{idle, ready}));
    EXPECT_EQ(xrEndSession(client.session), XR_ERROR_SESSION_NOT_RUNNING);
    EXPECT_EQ(xrRequestExitSession(client.session), XR_ERROR_SESSION_NOT_RUNNING);
    XrFrameState state{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
    EXPECT_EQ(xrWaitFrame(client.session, nullptr, &state), XR_ERROR_SESSION_NOT_RUNNING);

    const XrSessionBeginInfo mono{XR_TYPE_SESSION_BEGIN_INFO, nullptr,
                                  XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO};
    EXPECT_EQ(xrBeginSession(client.session, &mono), XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
    client.begin_session();
    const XrSessionBeginInfo quad{XR_TYPE_SESSION_BEGIN_INFO, nullptr,
                                  XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO};
    EXPECT_EQ(xrBeginSession(client.session, &quad), XR_ERROR_SESSION_RUNNING);
    EXPECT_EQ(client.take_states(), States{}) << "no frame yet";

    EXPECT_TRUE(client.empty_frame().shouldRender) << "the first frame is the first of the session";
    EXPECT_EQ(client.take_states(), (States{synchronized, visible, focused}));
    EXPECT_EQ(xrEndSession(client.session), XR_ERROR_SESSION_NOT_STOPPING);

    ASSERT_XR_SUCCESS(xrRequestExitSession(client.session));
    EXPECT_EQ(client.take_states(), (States{visible, synchronized, stopping}));
    EXPECT_FALSE(client.empty_frame().shouldRender);
    ASSERT_XR_SUCCESS(xrEndSession(client.session));
    EXPECT_EQ(client.take_states(), (States{idle, exiting}));
    EXPECT_EQ(xrBeginSession(client.session, &quad), XR_ERROR_SESSION_NOT_READY);
}

TEST(SessionStates, PlainStereoClientOfTheFirstVulkanExtension) {
    set_environment({});
    SimulatorClient client({XR_KHR_VULKAN_ENABLE_EXTENSION_NAME});
    client.create_session(VulkanEnable::First);
    client.begin_session(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    EXPECT_TRUE(client.empty_frame().shouldRender);
}

TEST(SessionStates, CreationVerifiesItsArguments) {
    set_environment({});
    {
        SimulatorClient hasty;
        XrGraphicsBindingVulkanKHR binding{};
        binding.type = XR_TYPE_GRAPHICS_BINDING_VULKAN_KHR;
        const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &binding, 0, hasty.system};
        XrSession none = XR_NULL_HANDLE;
        EXPECT_EQ(xrCreateSession(hasty.instance, &info, &none), XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
    }

    set_environment({});
    SimulatorClient client;
    client.create_session();
    const XrSessionCreateInfo second{XR_TYPE_SESSION_CREATE_INFO, &client.vulkan->binding(), 0,
                                     client.system};
    XrSession session = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateSession(client.instance, &second, &session), XR_ERROR_LIMIT_REACHED);
    const XrSessionCreateInfo unknown_system{XR_TYPE_SESSION_CREATE_INFO, &client.vulkan->binding(), 0, 77};
    EXPECT_EQ(xrCreateSession(client.instance, &unknown_system, &session), XR_ERROR_SYSTEM_INVALID);
    const XrSessionCreateInfo no_graphics{XR_TYPE_SESSION_CREATE_INFO, nullptr, 0, client.system};
    EXPECT_EQ(xrCreateSession(client.instance, &no_graphics, &session), XR_ERROR_GRAPHICS_DEVICE_INVALID);
    ASSERT_XR_SUCCESS(xrDestroySession(client.session));
    client.session = XR_NULL_HANDLE;
    ASSERT_XR_SUCCESS(xrCreateSession(client.instance, &second, &client.session))
        << "after the first is gone";
}

TEST(FrameLoop, CallOrder) {
    set_environment({});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_ERROR_CALL_ORDER_INVALID);
    EXPECT_EQ(client.end_frame(1), XR_ERROR_CALL_ORDER_INVALID);
    XrFrameState state = client.wait_frame();
    EXPECT_EQ(client.end_frame(state.predictedDisplayTime), XR_ERROR_CALL_ORDER_INVALID);
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_SUCCESS);
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_ERROR_CALL_ORDER_INVALID);
    state = client.wait_frame();
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_FRAME_DISCARDED);
    EXPECT_EQ(client.end_frame(0), XR_ERROR_TIME_INVALID);
    EXPECT_EQ(client.end_frame(state.predictedDisplayTime, {}, XR_ENVIRONMENT_BLEND_MODE_ADDITIVE),
              XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED);
    EXPECT_EQ(client.end_frame(state.predictedDisplayTime, {}, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND),
              XR_SUCCESS);
    EXPECT_EQ(client.end_frame(state.predictedDisplayTime), XR_ERROR_CALL_ORDER_INVALID);
}

TEST(FrameLoop, WaitingAheadBlocksUntilTheFrameBeforeIsBegun) {
    set_environment({});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    const XrFrameState first = client.wait_frame();
    XrFrameState second{};
    std::thread waiter([&] { second = client.wait_frame(); });
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_SUCCESS);
    waiter.join();
    EXPECT_EQ(second.predictedDisplayTime, first.predictedDisplayTime + first.predictedDisplayPeriod);
    EXPECT_EQ(client.end_frame(first.predictedDisplayTime), XR_SUCCESS);
}

TEST(FrameLoop, DestroyingTheSessionFreesAWaitingThread) {
    set_environment({});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    client.wait_frame();
    XrResult result = XR_SUCCESS;
    std::thread waiter([&] {
        XrFrameState state{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
        result = xrWaitFrame(client.session, nullptr, &state);
    });
    EXPECT_EQ(xrDestroySession(client.session), XR_SUCCESS);
    waiter.join();
    EXPECT_EQ(result, XR_ERROR_HANDLE_INVALID);
    client.session = XR_NULL_HANDLE;
}

TEST(VirtualTime, EachFrameAdvancesOnePeriod) {
    set_environment({});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    const XrFrameState first = client.empty_frame();
    EXPECT_EQ(first.predictedDisplayPeriod, 33'333'334);
    for (int i = 1; i < 50; ++i) {
        EXPECT_EQ(client.empty_frame().predictedDisplayTime,
                  first.predictedDisplayTime + i * first.predictedDisplayPeriod);
    }
}

TEST(RealTime, FramesFallOnWholePeriods) {
    set_environment({{"TIME", "real"}});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    const XrFrameState first = client.empty_frame();
    XrTime last = first.predictedDisplayTime;
    for (int i = 0; i < 3; ++i) {
        const XrFrameState state = client.empty_frame();
        EXPECT_GT(state.predictedDisplayTime, last);
        EXPECT_EQ((state.predictedDisplayTime - first.predictedDisplayTime) % first.predictedDisplayPeriod,
                  0);
        last = state.predictedDisplayTime;
    }
}

TEST(ScriptedSession, StopsAfterItsLastFrame) {
    fakes::TemporaryFolder folder;
    write_session(folder.path() / "s", make_session(3));
    set_environment({{"SESSION", folder.path() / "s"}});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(client.take_states().empty(), i > 1) << i;
        EXPECT_TRUE(client.empty_frame().shouldRender) << i;
    }
    EXPECT_EQ(client.take_states(), (States{visible, synchronized, stopping}));
    EXPECT_FALSE(client.empty_frame().shouldRender) << "a client may go on for a while";
    ASSERT_XR_SUCCESS(xrEndSession(client.session));
    EXPECT_EQ(client.take_states(), (States{idle, exiting}));
}

TEST(ScriptedSession, RunsAtItsOwnRate) {
    fakes::TemporaryFolder folder;
    Session script = make_session(10);
    script.rate_hz = 50.0;
    write_session(folder.path() / "s", script);
    set_environment({{"SESSION", folder.path() / "s"}});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    EXPECT_EQ(client.empty_frame().predictedDisplayPeriod, 20'000'000);
}

TEST(ScriptedSession, IsReadyAgainAfterAPause) {
    fakes::TemporaryFolder folder;
    Session script = make_session(100);
    script.events = {{from_seconds(1 / 30.0), "session_pause", ""}};
    write_session(folder.path() / "s", script);
    set_environment({{"SESSION", folder.path() / "s"}});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    client.empty_frame();
    client.take_states();
    EXPECT_FALSE(client.empty_frame().shouldRender);
    EXPECT_EQ(client.take_states(), (States{visible, synchronized, stopping}));
    ASSERT_XR_SUCCESS(xrEndSession(client.session));
    EXPECT_EQ(client.take_states(), (States{idle, ready}));
    XrFrameState state{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
    EXPECT_EQ(xrWaitFrame(client.session, nullptr, &state), XR_ERROR_SESSION_NOT_RUNNING);
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_ERROR_SESSION_NOT_RUNNING);
    EXPECT_EQ(client.end_frame(1), XR_ERROR_SESSION_NOT_RUNNING);
    client.begin_session();
    EXPECT_TRUE(client.empty_frame().shouldRender);
    EXPECT_EQ(client.take_states(), (States{synchronized, visible, focused}));
    ASSERT_XR_SUCCESS(xrRequestExitSession(client.session));
    ASSERT_XR_SUCCESS(xrEndSession(client.session));
    EXPECT_EQ(client.take_states(), (States{visible, synchronized, stopping, idle, exiting}));
}

TEST(ScriptedSession, LossIsAnnouncedAndThenRefused) {
    fakes::TemporaryFolder folder;
    Session script = make_session(100);
    script.events = {{from_seconds(1 / 30.0), "session_loss", ""}};
    write_session(folder.path() / "s", script);
    set_environment({{"SESSION", folder.path() / "s"}});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    client.empty_frame();
    client.take_states();
    client.empty_frame();
    EXPECT_EQ(client.take_states(), States{XR_SESSION_STATE_LOSS_PENDING});
    XrFrameState state{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
    EXPECT_EQ(xrWaitFrame(client.session, nullptr, &state), XR_ERROR_SESSION_LOST);
    EXPECT_EQ(xrRequestExitSession(client.session), XR_ERROR_SESSION_LOST);
    EXPECT_EQ(xrDestroySession(client.session), XR_SUCCESS);
    client.session = XR_NULL_HANDLE;
}

TEST(ScriptedSession, EventsMoveTheStates) {
    fakes::TemporaryFolder folder;
    Session script = make_session(100);
    script.events = {
        {from_seconds(1 / 30.0), "focus_lost", ""},        {from_seconds(2 / 30.0), "visibility_lost", ""},
        {from_seconds(3 / 30.0), "visibility_gained", ""}, {from_seconds(4 / 30.0), "focus_gained", ""},
        {from_seconds(5 / 30.0), "of the client", "7"},    {from_seconds(6 / 30.0), "exit", ""}};
    write_session(folder.path() / "s", script);
    set_environment({{"SESSION", folder.path() / "s"}});
    SimulatorClient client;
    client.create_session();
    client.begin_session();
    client.empty_frame();
    client.take_states();
    const std::pair<States, bool> expected[] = {
        {{visible}, true}, {{synchronized}, false},
        {{visible}, true}, {{focused}, true},
        {{}, true},        {{visible, synchronized, stopping}, false},
    };
    for (const auto& [states, should_render] : expected) {
        EXPECT_EQ(client.empty_frame().shouldRender, should_render);
        EXPECT_EQ(client.take_states(), states);
    }
}

}  // namespace
}  // namespace foveray::simulator_tests
