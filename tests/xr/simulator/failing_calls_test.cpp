// faults.csv: calls that fail, what the file's mistakes are answered with, and lost sessions and instances.
#include "tests/xr/simulator/direct_runtime.h"
#include "tests/xr/simulator/faults_file.h"

namespace foveray::simulator_tests {
namespace {

constexpr auto loss_pending = XR_SESSION_STATE_LOSS_PENDING;
using States = std::vector<XrSessionState>;

TEST(FaultsFile, MistakesFailTheInstanceAndSayWhereAndWhat) {
    const std::pair<const char*, const char*> cases[] = {
        {"soon,exit,", "'soon' is no frame or time"},
        {"5m,exit,", "'5m' is no frame or time"},
        {"-1,exit,", "'-1' is no frame or time"},
        {"-1s,exit,", "'-1s' is no frame or time"},
        {"1,explode,", "'explode' is no fault"},
        {"1,exit,now", "'now' is no value for exit"},
        {"1,loss_pending,", "'' is no value for loss_pending"},
        {"1,slow_compositor,fast", "'fast' is no value for slow_compositor"},
        {"1,slow_compositor,nan", "'nan' is no value for slow_compositor"},
        {"1,swapchain_timeout,0", "'0' is no value for swapchain_timeout"},
        {"1,fail,xrEndFrame", "'xrEndFrame' names no error"},
        {"1,fail,xrEndFrames=XR_ERROR_RUNTIME_FAILURE", "'xrEndFrames' is no function"},
        {"1,fail,xrEndFrame=XR_ERROR_OOPS", "'XR_ERROR_OOPS' is no result"},
        {"1,fail,xrEndFrame=XR_ERROR_PATH_INVALID", "xrEndFrame may not answer XR_ERROR_PATH_INVALID"},
        {"1,fail,xrWaitFrame=XR_SESSION_LOSS_PENDING", "xrWaitFrame may not answer"},
        {"1,fail,xrWaitFrame=XR_ERROR_RUNTIME_FAILURE 3", "'3' is no number of calls"},
        {"1,fail,xrWaitFrame=XR_ERROR_RUNTIME_FAILURE x0", "'x0' is no number of calls"},
        {"1,out_of_memory,xrDestroySession", "xrDestroySession may not answer XR_ERROR_OUT_OF_MEMORY"},
        {"start,instance_loss,", "cannot be lost before it is made"},
        {"1,exit", "has 2 fields"},
    };
    for (const auto& [line, complaint] : cases) {
        const FaultsFile file("0,focus_lost,\n" + std::string(line) + "\n");
        XrInstance instance = XR_NULL_HANDLE;
        testing::internal::CaptureStderr();
        EXPECT_EQ(create_instance(&instance), XR_ERROR_RUNTIME_FAILURE) << line;
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_NE(said.find(file.path() + ":3"), std::string::npos) << said;
        EXPECT_NE(said.find(complaint), std::string::npos) << said;
    }
    set_environment({{"FAULTS", "/nowhere/faults.csv"}});
    XrInstance instance = XR_NULL_HANDLE;
    EXPECT_EQ(create_instance(&instance), XR_ERROR_RUNTIME_FAILURE);
}

TEST(FaultsFile, IsReadFromTheSessionFolderToo) {
    fakes::TemporaryFolder folder;
    write_session(folder.path() / "s", make_session(10));
    std::ofstream(folder.path() / "s" / "faults.csv")
        << "at,fault,value\n0,fail,xrBeginFrame=XR_ERROR_RUNTIME_FAILURE\n";
    set_environment({{"SESSION", folder.path() / "s"}});
    SimulatorClient client(headless_extensions);
    begin_headless(client);
    client.wait_frame();
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_ERROR_RUNTIME_FAILURE);
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_SUCCESS);
}

TEST(FailingCalls, AnswerTheErrorAndDoNothing) {
    const FaultsFile file("2,fail,xrEndFrame=XR_ERROR_LAYER_INVALID x2\n");
    SimulatorClient client(headless_extensions);
    begin_headless(client);
    client.empty_frame();
    const XrFrameState state = client.wait_frame();
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_SUCCESS);
    EXPECT_EQ(client.end_frame(state.predictedDisplayTime), XR_ERROR_LAYER_INVALID);
    EXPECT_EQ(client.end_frame(state.predictedDisplayTime), XR_ERROR_LAYER_INVALID);
    EXPECT_EQ(client.end_frame(state.predictedDisplayTime), XR_SUCCESS) << "the frame is still under way";
    EXPECT_EQ(client.end_frame(state.predictedDisplayTime), XR_ERROR_CALL_ORDER_INVALID);
}

TEST(FailingCalls, ComeInTheFilesOrderAndForAlways) {
    const FaultsFile file(
        "start,fail,xrStringToPath=XR_ERROR_PATH_COUNT_EXCEEDED\n"
        "start,fail,xrStringToPath=XR_ERROR_RUNTIME_FAILURE always\n"
        "start,out_of_memory,xrCreateSession\n");
    SimulatorClient client(headless_extensions);
    XrPath path = XR_NULL_PATH;
    EXPECT_EQ(xrStringToPath(client.instance, "/a", &path), XR_ERROR_PATH_COUNT_EXCEEDED);
    for (int i = 0; i < 10; ++i)
        EXPECT_EQ(xrStringToPath(client.instance, "/a", &path), XR_ERROR_RUNTIME_FAILURE);
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, nullptr, 0, client.system};
    EXPECT_EQ(xrCreateSession(client.instance, &info, &client.session), XR_ERROR_OUT_OF_MEMORY);
    EXPECT_EQ(client.session, XrSession{XR_NULL_HANDLE});
    client.create_headless_session();
}

TEST(FailingCalls, ReachFunctionsWithoutAnInstance) {
    const FaultsFile file("start,fail,xrCreateInstance=XR_ERROR_RUNTIME_UNAVAILABLE x2\n");
    XrInstance instance = XR_NULL_HANDLE;
    EXPECT_EQ(create_instance(&instance), XR_ERROR_RUNTIME_UNAVAILABLE);
    EXPECT_EQ(create_instance(&instance), XR_ERROR_RUNTIME_UNAVAILABLE);
    ASSERT_XR_SUCCESS(create_instance(&instance));
    EXPECT_EQ(xrDestroyInstance(instance), XR_SUCCESS);

    const FaultsFile second("start,fail,xrEnumerateInstanceExtensionProperties=XR_ERROR_RUNTIME_FAILURE\n");
    DirectRuntime runtime;  // the loader would ask several times and answer itself
    const auto enumerate = runtime.load<PFN_xrEnumerateInstanceExtensionProperties>(
        XR_NULL_HANDLE, "xrEnumerateInstanceExtensionProperties");
    std::uint32_t count = 0;
    EXPECT_EQ(enumerate(nullptr, 0, &count, nullptr), XR_ERROR_RUNTIME_FAILURE);
    EXPECT_EQ(enumerate(nullptr, 0, &count, nullptr), XR_SUCCESS);
}

TEST(FailingCalls, ReachAnInstanceThatTakesALostOnesPlace) {
    const FaultsFile file(
        "1,instance_loss,\n"
        "1,fail,xrCreateInstance=XR_ERROR_RUNTIME_UNAVAILABLE\n"
        "1,fail,xrGetSystem=XR_ERROR_RUNTIME_FAILURE x2\n");
    {
        SimulatorClient client(headless_extensions);
        begin_headless(client);
        client.wait_frame();
        EXPECT_EQ(try_wait_frame(client), XR_ERROR_INSTANCE_LOST);
    }
    XrInstance instance = XR_NULL_HANDLE;
    EXPECT_EQ(create_instance(&instance), XR_ERROR_RUNTIME_UNAVAILABLE);
    ASSERT_XR_SUCCESS(create_instance(&instance));
    EXPECT_EQ(try_get_system(instance), XR_ERROR_RUNTIME_FAILURE);
    EXPECT_EQ(try_get_system(instance), XR_ERROR_RUNTIME_FAILURE);
    EXPECT_EQ(try_get_system(instance), XR_SUCCESS);
    EXPECT_EQ(xrDestroyInstance(instance), XR_SUCCESS);
}

TEST(InstanceLoss, EveryCallAnswersItAndTheNextInstanceGoesOn) {
    const FaultsFile file("2,instance_loss,\n4,focus_lost,\n");
    XrTime last = 0;
    {
        SimulatorClient client(headless_extensions);
        begin_headless(client);
        const XrSpace space = client.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
        client.empty_frame();
        last = client.wait_frame().predictedDisplayTime;
        EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_ERROR_INSTANCE_LOST);
        EXPECT_EQ(client.end_frame(last), XR_ERROR_INSTANCE_LOST);
        EXPECT_EQ(xrRequestExitSession(client.session), XR_ERROR_INSTANCE_LOST);
        EXPECT_EQ(try_get_system(client.instance), XR_ERROR_INSTANCE_LOST);
        XrSpaceLocation location{};
        location.type = XR_TYPE_SPACE_LOCATION;
        EXPECT_EQ(xrLocateSpace(space, space, last, &location), XR_ERROR_INSTANCE_LOST);
        XrEventDataBuffer event{};
        event.type = XR_TYPE_EVENT_DATA_BUFFER;
        EXPECT_EQ(xrPollEvent(client.instance, &event), XR_ERROR_INSTANCE_LOST);
        EXPECT_EQ(xrDestroySpace(space), XR_SUCCESS) << "the specification knows no other answer";
        EXPECT_EQ(xrDestroySession(client.session), XR_SUCCESS);
        client.session = XR_NULL_HANDLE;
    }
    SimulatorClient next(headless_extensions);
    begin_headless(next);
    next.take_states();
    const XrFrameState fourth = next.empty_frame();  // the session's begin played the third
    EXPECT_EQ(fourth.predictedDisplayTime, last + 2 * fourth.predictedDisplayPeriod);
    EXPECT_EQ(next.take_states(), (States{XR_SESSION_STATE_VISIBLE})) << "the loss is not played again";
}

TEST(InstanceLoss, IsAnnouncedWithItsTime) {
    const FaultsFile file("1,instance_loss_pending,0.1\n");
    SimulatorClient client(headless_extensions);
    begin_headless(client);
    client.take_states();
    const XrFrameState frame = client.empty_frame();  // the first after the begin
    client.take_states();
    ASSERT_EQ(client.other_events.size(), 1u);
    const auto& event = reinterpret_cast<const XrEventDataInstanceLossPending&>(client.other_events[0]);
    ASSERT_EQ(event.type, XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING);
    EXPECT_EQ(event.lossTime, frame.predictedDisplayTime + 100'000'000);
    XrTime time = frame.predictedDisplayTime;
    while (time + frame.predictedDisplayPeriod < event.lossTime)
        time = client.empty_frame().predictedDisplayTime;
    client.wait_frame();
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_ERROR_INSTANCE_LOST);
}

TEST(SessionLoss, EveryCallOnItAnswersItAndAnotherSessionGoesOn) {
    const FaultsFile file("2,session_loss,\n");
    SimulatorClient client(headless_extensions);
    begin_headless(client);
    const XrSpace space = client.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    client.empty_frame();
    client.take_states();
    const XrFrameState last = client.empty_frame();
    EXPECT_EQ(client.take_states(), States{loss_pending});
    EXPECT_EQ(try_wait_frame(client), XR_ERROR_SESSION_LOST);
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_ERROR_SESSION_LOST);
    EXPECT_EQ(xrEndSession(client.session), XR_ERROR_SESSION_LOST);
    XrSpaceLocation location{};
    location.type = XR_TYPE_SPACE_LOCATION;
    EXPECT_EQ(xrLocateSpace(space, space, last.predictedDisplayTime, &location), XR_ERROR_SESSION_LOST);
    EXPECT_EQ(try_get_system(client.instance), XR_SUCCESS);
    EXPECT_EQ(xrDestroySession(client.session), XR_SUCCESS);

    begin_headless(client);
    EXPECT_GT(client.empty_frame().predictedDisplayTime, last.predictedDisplayTime);
    EXPECT_EQ(client.take_states().back(), XR_SESSION_STATE_FOCUSED) << "it is not lost again";
}

TEST(SessionLoss, GivesNotice) {
    const FaultsFile file("2,loss_pending,0.1\n");  // until frame 5
    SimulatorClient client(headless_extensions);
    begin_headless(client);
    client.empty_frame();
    client.take_states();
    EXPECT_EQ(try_wait_frame(client), XR_SESSION_LOSS_PENDING);
    EXPECT_EQ(client.take_states(), States{loss_pending});
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_SESSION_LOSS_PENDING);
    EXPECT_EQ(client.end_frame(1), XR_SESSION_LOSS_PENDING);
    int frames = 0;
    XrResult result = XR_SUCCESS;
    while (XR_SUCCEEDED(result = try_wait_frame(client)) && ++frames < 10) {
        EXPECT_EQ(result, XR_SESSION_LOSS_PENDING);
        EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_SESSION_LOSS_PENDING);
        EXPECT_EQ(client.end_frame(1), XR_SESSION_LOSS_PENDING);
    }
    EXPECT_EQ(result, XR_ERROR_SESSION_LOST);
    EXPECT_EQ(frames, 2);
    EXPECT_EQ(xrDestroySession(client.session), XR_SUCCESS);
    client.session = XR_NULL_HANDLE;
}

}  // namespace
}  // namespace foveray::simulator_tests
