// The control socket: commands, stepped time, garbage, several programs and ones that are killed.
#include <atomic>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "tests/xr/simulator/action_client.h"
#include "tests/xr/simulator/control_connection.h"
#include "tests/xr/simulator/direct_runtime.h"
#include "tests/xr/simulator/faults_file.h"

namespace foveray::simulator_tests {
namespace {

namespace fs = std::filesystem;

/// A folder for control sockets and a headless session that listens there.
struct ControlTest : testing::Test {
    explicit ControlTest() {
        setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
        set_environment({{"CONTROL", "1"}});
    }
    ~ControlTest() override { unsetenv("XDG_RUNTIME_DIR"); }

    fs::path socket_of(pid_t process) const {
        return folder.path() / "foveray-simulator" / std::to_string(process);
    }
    fs::path socket() const { return socket_of(getpid()); }

    fakes::TemporaryFolder folder;
};

TEST_F(ControlTest, CommandsHoldFromTheNextFrameOn) {
    SimulatorClient client(headless_extensions);
    begin_headless(client);
    const XrSpace head = client.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW),
                  stage = client.reference_space(XR_REFERENCE_SPACE_TYPE_STAGE),
                  local = client.reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
    const XrTime before = client.empty_frame().predictedDisplayTime;
    ControlConnection connection(socket());
    EXPECT_EQ(connection.ask("head 1 2 3 0 0.6 0 0.8"), "ok");
    EXPECT_FLOAT_EQ(client.locate(head, stage, before).pose.position.x, 0.0f) << "not this frame any more";
    const XrTime after = client.empty_frame().predictedDisplayTime;
    const XrSpaceLocation found = client.locate(head, stage, after);
    EXPECT_FLOAT_EQ(found.pose.position.x, 1.0f);
    EXPECT_FLOAT_EQ(found.pose.position.z, 3.0f);
    EXPECT_FLOAT_EQ(found.pose.orientation.y, 0.6f);
    EXPECT_FLOAT_EQ(client.locate(head, stage, before).pose.position.x, 0.0f) << "the past stays";
    EXPECT_FLOAT_EQ(client.locate(local, stage, after).pose.position.x, 0.0f);

    EXPECT_EQ(connection.ask("fault recenter"), "ok");
    EXPECT_EQ(connection.ask("head script"), "ok");
    EXPECT_EQ(connection.ask("fault position_tracking_lost"), "ok");
    const XrTime last = client.empty_frame().predictedDisplayTime;
    EXPECT_FLOAT_EQ(client.locate(head, stage, last).pose.position.x, 0.0f);
    EXPECT_EQ(client.locate(head, stage, last).locationFlags & XR_SPACE_LOCATION_POSITION_TRACKED_BIT, 0u);
}

TEST_F(ControlTest, ControllersAndGazeFollowCommands) {
    auto made = std::make_unique<SimulatorClient>(headless_extensions);
    begin_headless(*made);
    ActionClient actions(std::move(made));
    SimulatorClient& client = *actions.client;
    const XrActionSet set = actions.create_set("set");
    const XrAction fire = actions.create(set, "fire", XR_ACTION_TYPE_BOOLEAN_INPUT),
                   hand = actions.create(set, "hand", XR_ACTION_TYPE_POSE_INPUT),
                   look = actions.create(set, "look", XR_ACTION_TYPE_POSE_INPUT);
    ASSERT_XR_SUCCESS(actions.suggest("khr/simple_controller", {{fire, "/user/hand/left/input/select/click"},
                                                                {hand, "/user/hand/left/input/grip/pose"}}));
    ASSERT_XR_SUCCESS(
        actions.suggest("ext/eye_gaze_interaction", {{look, "/user/eyes_ext/input/gaze_ext/pose"}}));
    ASSERT_XR_SUCCESS(actions.attach({set}));
    const XrSpace grip = actions.create_space(hand), gaze = actions.create_space(look),
                  stage = client.reference_space(XR_REFERENCE_SPACE_TYPE_STAGE),
                  head = client.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    const auto frame = [&] {
        const XrTime time = client.empty_frame().predictedDisplayTime;
        EXPECT_EQ(actions.sync({{set, XR_NULL_PATH}}), XR_SUCCESS);
        return time;
    };
    frame();
    EXPECT_FALSE(actions.read_boolean(fire).isActive) << "no controllers in this script";

    ControlConnection connection(socket());
    EXPECT_EQ(connection.ask("press left/trigger"), "ok");
    EXPECT_EQ(connection.ask("gaze 1 0 -1"), "ok");
    XrTime time = frame();
    EXPECT_TRUE(actions.read_boolean(fire).currentState);
    EXPECT_LT(client.locate(grip, stage, time).pose.position.x, 0.0f) << "the left hand at rest";
    EXPECT_NEAR(client.locate(gaze, head, time).pose.orientation.y, -std::sin(0.785398f / 2.0f), 1e-5f);

    EXPECT_EQ(connection.ask("controller left 4 5 6 0 0 0 1"), "ok");
    EXPECT_EQ(connection.ask("release left/trigger"), "ok");
    EXPECT_EQ(connection.ask("gaze invalid"), "ok");
    time = frame();
    EXPECT_FALSE(actions.read_boolean(fire).currentState);
    EXPECT_FLOAT_EQ(client.locate(grip, stage, time).pose.position.y, 5.0f);
    EXPECT_EQ(client.locate(gaze, head, time).locationFlags, 0u);

    EXPECT_EQ(connection.ask("controller left script"), "ok");
    EXPECT_EQ(connection.ask("gaze script"), "ok");
    time = frame();
    EXPECT_FALSE(actions.read_boolean(fire).isActive);
    EXPECT_NEAR(client.locate(gaze, head, time).pose.orientation.y, 0.0f, 1e-6f);
}

TEST_F(ControlTest, GarbageIsAnsweredAndHurtsNobody) {
    SimulatorClient client(headless_extensions);
    begin_headless(client);
    ControlConnection connection(socket());
    for (const char* wrong : {"fly",
                              "head",
                              "head 1 2 3",
                              "head a b c d e f g",
                              "head 0 0 0 0 0 0 0",
                              "head nan 0 0 0 0 0 1",
                              "head 1 2 3 0 0 0 1 9",
                              "gaze 0 0 0",
                              "gaze 1",
                              "gaze inf 0 0",
                              "controller",
                              "controller middle 1",
                              "controller left 1 2",
                              "press",
                              "press trigger",
                              "press left/nose",
                              "press up/trigger",
                              "set left/trigger 2",
                              "set left/stick_x -1.5",
                              "set left/trigger",
                              "fault",
                              "fault explode",
                              "fault fail xrEndFrame",
                              "fault slow_compositor",
                              "fault exit 5",
                              "step",
                              "state\x01\xff",
                              "\xff\xfe",
                              "   "}) {
        EXPECT_EQ(connection.ask(wrong).substr(0, 6), "error ") << wrong;
    }
    EXPECT_NE(connection.ask("step").find("time is not stepped"), std::string::npos);
    connection.send(std::string("\0\0\n\r\n\nstate\r\n", 13));
    EXPECT_EQ(connection.reply().substr(0, 6), "error ");
    EXPECT_EQ(connection.reply().substr(0, 16), "ok state=FOCUSED") << "empty lines are no commands";
    connection.send("sta");
    connection.send("te\nsta");
    EXPECT_EQ(connection.reply().substr(0, 2), "ok");

    ControlConnection endless(socket());
    endless.send(std::string(5000, 'x'));
    EXPECT_EQ(endless.reply(), "error the line is too long");
    EXPECT_EQ(endless.reply(), "") << "and the connection is closed";

    for (int i = 0; i < 100; ++i) {  // gone before the reply
        ControlConnection gone(socket());
        gone.send("state\nstate\nst");
    }
    std::string many;
    for (int i = 0; i < 300; ++i) many += "state\n";
    ControlConnection batch(socket());
    batch.send(many);
    for (int i = 0; i < 300; ++i) ASSERT_EQ(batch.reply().substr(0, 2), "ok") << i;
    EXPECT_EQ(connection.ask("te").substr(0, 2), "ok");
}

TEST_F(ControlTest, SendersOutliveTheInstance) {
    auto client = std::make_unique<SimulatorClient>(headless_extensions);
    begin_headless(*client);
    ControlConnection connection(socket()), other(socket());
    EXPECT_EQ(other.ask("state").substr(0, 2), "ok");
    client.reset();
    EXPECT_EQ(connection.reply(), "");
    EXPECT_FALSE(fs::exists(socket()));
    SimulatorClient next(headless_extensions);
    EXPECT_EQ(ControlConnection(socket()).ask("state").substr(0, 13), "ok state=none");
}

TEST_F(ControlTest, AnotherHeadsetsSocketIsNotTaken) {
    DirectRuntime runtime;  // the loader has one instance at a time
    const XrInstance first = runtime.create_instance({});
    testing::internal::CaptureStderr();
    const XrInstance second = runtime.create_instance({});
    EXPECT_NE(second, XrInstance{XR_NULL_HANDLE});
    set_environment({{"CONTROL", folder.path() / "named"}});
    const XrInstance third = runtime.create_instance({});
    EXPECT_EQ(runtime.create_instance({}), XrInstance{XR_NULL_HANDLE}) << "its socket was asked for by name";
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("second headset has no control socket"), std::string::npos) << said;
    EXPECT_NE(said.find("another headset listens there"), std::string::npos) << said;
    const auto destroy = runtime.load<PFN_xrDestroyInstance>(first, "xrDestroyInstance");
    EXPECT_EQ(destroy(second), XR_SUCCESS);
    EXPECT_EQ(destroy(third), XR_SUCCESS);
    EXPECT_EQ(ControlConnection(socket()).ask("state").substr(0, 2), "ok");
    EXPECT_EQ(destroy(first), XR_SUCCESS);
}

TEST_F(ControlTest, PlacesWithoutASocketFailTheInstanceAndSayWhy) {
    const fs::path open_folder = folder.path() / "foveray-simulator";
    fs::create_directory(open_folder);
    fs::permissions(open_folder, fs::perms::all);
    const std::pair<std::string, const char*> cases[] = {
        {folder.path() / "nowhere" / "socket", "No such file"},
        {std::string(200, 'a'), "path is too long"},
        {"1", "open to others"},
        {folder.path(), "in use"},
    };
    for (const auto& [path, complaint] : cases) {
        set_environment({{"CONTROL", path}});
        XrInstance instance = XR_NULL_HANDLE;
        testing::internal::CaptureStderr();
        EXPECT_EQ(create_instance(&instance), XR_ERROR_RUNTIME_FAILURE) << path;
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_NE(said.find(complaint), std::string::npos) << said;
    }
}

TEST_F(ControlTest, FaultsComeByCommand) {
    SimulatorClient client(headless_extensions);
    ControlConnection connection(socket());
    EXPECT_EQ(connection.ask("fault form_factor_lost"), "ok");
    EXPECT_EQ(try_get_system(client.instance), XR_ERROR_FORM_FACTOR_UNAVAILABLE) << "without a frame";
    EXPECT_EQ(connection.ask("fault form_factor_gained"), "ok");
    EXPECT_EQ(try_get_system(client.instance), XR_SUCCESS);
    EXPECT_EQ(connection.ask("fault fail xrGetSystem=XR_ERROR_RUNTIME_FAILURE x2"), "ok");
    EXPECT_EQ(try_get_system(client.instance), XR_ERROR_RUNTIME_FAILURE);
    EXPECT_EQ(try_get_system(client.instance), XR_ERROR_RUNTIME_FAILURE);
    EXPECT_EQ(try_get_system(client.instance), XR_SUCCESS);
    begin_headless(client);
    client.empty_frame();
    client.take_states();
    EXPECT_EQ(connection.ask("fault focus_lost"), "ok");
    client.empty_frame();
    EXPECT_EQ(client.take_states(), std::vector{XR_SESSION_STATE_VISIBLE});
    EXPECT_EQ(connection.ask("exit"), "ok");
    client.empty_frame();
    EXPECT_EQ(client.take_states().back(), XR_SESSION_STATE_STOPPING);
    EXPECT_EQ(connection.ask("fault instance_loss"), "ok");
    client.wait_frame();
    EXPECT_EQ(try_wait_frame(client), XR_ERROR_INSTANCE_LOST);
    EXPECT_EQ(xrDestroySession(client.session), XR_SUCCESS);
    client.session = XR_NULL_HANDLE;
    EXPECT_EQ(xrDestroyInstance(client.instance), XR_SUCCESS);
    ASSERT_XR_SUCCESS(create_instance(&client.instance));  // goes on; one after it starts anew
}

/// Shows frames until its session ends.
void run_client(SimulatorClient& client) {
    begin_headless(client);
    for (bool ends = false; !ends;) {
        client.empty_frame();
        for (const XrSessionState state : client.take_states()) ends |= state == XR_SESSION_STATE_STOPPING;
    }
    EXPECT_EQ(xrEndSession(client.session), XR_SUCCESS);
}

TEST_F(ControlTest, SteppedTimeGoesFrameByFrame) {
    set_environment({{"TIME", "stepped"}});
    SimulatorClient client(headless_extensions);
    std::thread program([&] { run_client(client); });
    ControlConnection connection(socket());
    EXPECT_EQ(connection.ask("step"), "ok frame=1") << "the session's begin shows frame 0";
    EXPECT_EQ(connection.ask("step 5"), "ok frame=6");
    const std::string state = connection.ask("state");
    EXPECT_EQ(state.substr(0, 40), "ok state=FOCUSED frame=6 time_ns=2000000") << state;
    EXPECT_NE(state.find("waited=6 ended=6"), std::string::npos) << state;
    for (const char* wrong : {"step 0", "step -1", "step 1.5", "step x", "step 1 2"})
        EXPECT_EQ(connection.ask(wrong).substr(0, 6), "error ") << wrong;
    connection.send("step 2\nstate\nexit\nstep\n");
    EXPECT_EQ(connection.reply(), "ok frame=8");
    EXPECT_EQ(connection.reply().substr(0, 24), "ok state=FOCUSED frame=8") << "after the steps";
    EXPECT_EQ(connection.reply(), "ok");
    connection.reply();
    program.join();
    EXPECT_EQ(connection.ask("state").substr(0, 16), "ok state=EXITING");
}

TEST_F(ControlTest, NobodyWaitsForStepsOfASessionThatGoes) {
    set_environment({{"TIME", "stepped"}});
    SimulatorClient client(headless_extensions);
    begin_headless(client);
    std::atomic<bool> waits = false;
    std::thread program([&] {
        waits = true;
        EXPECT_EQ(try_wait_frame(client), XR_ERROR_HANDLE_INVALID);
    });
    while (!waits) std::this_thread::yield();
    ControlConnection connection(socket());
    EXPECT_EQ(connection.ask("state").substr(0, 2), "ok");
    EXPECT_EQ(xrDestroySession(client.session), XR_SUCCESS);
    client.session = XR_NULL_HANDLE;
    program.join();
    connection.send("step 3\n");  // for the next session

    begin_headless(client);
    ASSERT_XR_SUCCESS(try_wait_frame(client));
    EXPECT_EQ(xrRequestExitSession(client.session), XR_SUCCESS);
    EXPECT_EQ(xrEndSession(client.session), XR_SUCCESS);
    EXPECT_EQ(connection.reply(), "error the session ended");
}

TEST_F(ControlTest, RealTimeCountsMissedFrames) {
    set_environment({{"CONTROL", "1"}, {"TIME", "real"}});  // 30 Hz
    SimulatorClient client(headless_extensions);
    begin_headless(client);
    client.empty_frame();
    const XrFrameState slow = client.wait_frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    EXPECT_EQ(xrBeginFrame(client.session, nullptr), XR_SUCCESS);
    EXPECT_EQ(client.end_frame(slow.predictedDisplayTime), XR_SUCCESS);
    const std::string state = ControlConnection(socket()).ask("state");
    EXPECT_GE(std::stoi(state.substr(state.find("missed=") + 7)), 3) << state;
    EXPECT_GT(client.empty_frame().predictedDisplayTime,
              slow.predictedDisplayTime + 3 * slow.predictedDisplayPeriod);
}

TEST_F(ControlTest, ProgramsAreHeadsetsOfTheirOwnAndLeaveNothing) {
    set_environment({{"TIME", "stepped"}});
    const auto start = [] {
        const pid_t process = fork();
        if (process != 0) return process;
        {
            SimulatorClient client(headless_extensions);
            run_client(client);
        }
        _exit(testing::Test::HasFailure());
    };
    const pid_t first = start(), second = start();
    ControlConnection to_first(socket_of(first)), to_second(socket_of(second));
    EXPECT_EQ(to_first.ask("step 2"), "ok frame=2");
    EXPECT_EQ(to_second.ask("step 7"), "ok frame=7");
    EXPECT_EQ(to_first.ask("head 1 1 1 0 0 0 1"), "ok");
    EXPECT_EQ(to_first.ask("step"), "ok frame=3");

    kill(first, SIGKILL);
    int status = 0;
    EXPECT_EQ(waitpid(first, &status, 0), first);
    EXPECT_EQ(to_first.reply(), "");
    EXPECT_EQ(to_second.ask("step"), "ok frame=8") << "the other does not care";
    EXPECT_TRUE(fs::exists(socket_of(first)));
    {
        SimulatorClient third(headless_extensions);
        EXPECT_FALSE(fs::exists(socket_of(first))) << "the next headset removes it";
        EXPECT_TRUE(fs::exists(socket_of(second)));
        EXPECT_TRUE(fs::exists(socket()));
    }
    EXPECT_EQ(to_second.ask("exit"), "ok");
    to_second.ask("step");
    EXPECT_EQ(waitpid(second, &status, 0), second);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    EXPECT_TRUE(fs::is_empty(folder.path() / "foveray-simulator"));
}

}  // namespace
}  // namespace foveray::simulator_tests
