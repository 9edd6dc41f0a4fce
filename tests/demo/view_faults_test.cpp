// `foveray view` under every fault that the simulated headset can play: what it does, what it says, and that
// its recording can be read.
#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include "base/session.h"
#include "tests/demo/running_view.h"
#include "tests/fakes/environment.h"

namespace foveray {
namespace {

/// What is expected of a view of twelve frames.
struct Row {
    const char* name;
    const char* faults;  // lines of faults.csv
    int exit_code = 0;
    const char* says = "";                            // a part of what it says
    std::size_t least_frames = 12, most_frames = 12;  // recorded, with a pose; most 0: no recording
};

std::ostream& operator<<(std::ostream& out, const Row& row) { return out << row.name; }

constexpr Row rows[] = {
    {.name = "nothing", .faults = ""},
    {.name = "session_loss", .faults = "4,session_loss,\n", .says = "connected to", .least_frames = 10},
    {.name = "session_loss_twice",
     .faults = "4,session_loss,\n7,session_loss,\n",
     .says = "connected to",
     .least_frames = 9},
    {.name = "loss_pending", .faults = "4,loss_pending,0.1\n", .says = "connected to", .least_frames = 8},
    {.name = "instance_loss", .faults = "4,instance_loss,\n", .says = "connected to", .least_frames = 10},
    {.name = "instance_loss_pending",
     .faults = "4,instance_loss_pending,0.1\n",
     .says = "is shutting down; connecting again",
     .least_frames = 8},
    {.name = "headset_unplugged_and_back",
     .faults = "4,form_factor_lost,\n4,session_loss,\n6,form_factor_gained,\n",
     .says = "its headset is away",
     .least_frames = 8},
    {.name = "headset_late",
     .faults = "start,form_factor_lost,\n2,form_factor_gained,\n",
     .says = "waiting for it",
     .least_frames = 9},
    {.name = "headset_never_there",
     .faults = "start,form_factor_lost,\n",
     .exit_code = 3,
     .says = "connect the headset",
     .least_frames = 0,
     .most_frames = 0},
    {.name = "headset_unplugged_for_good",
     .faults = "4,form_factor_lost,\n4,session_loss,\n",
     .exit_code = 3,
     .says = "connect the headset",
     .least_frames = 4},
    {.name = "recenter", .faults = "4,recenter,\n"},
    {.name = "focus", .faults = "4,focus_lost,\n7,focus_gained,\n"},
    {.name = "visibility", .faults = "4,visibility_lost,\n7,visibility_gained,\n"},
    {.name = "user", .faults = "4,user_absent,\n7,user_present,\n"},
    {.name = "head_tracking",
     .faults = "4,head_tracking_lost,\n7,head_tracking_gained,\n",
     .least_frames = 9,
     .most_frames = 9},
    {.name = "position_tracking",
     .faults = "4,position_tracking_lost,\n7,position_tracking_gained,\n",
     .least_frames = 9},
    {.name = "orientation_tracking",
     .faults = "4,orientation_tracking_lost,\n7,orientation_tracking_gained,\n",
     .least_frames = 9},
    {.name = "gaze_tracking", .faults = "4,gaze_tracking_lost,\n7,gaze_tracking_gained,\n"},
    {.name = "visibility_mask", .faults = "4,visibility_mask_removed,\n7,visibility_mask_restored,\n"},
    {.name = "slow_compositor", .faults = "4,slow_compositor,50\n7,slow_compositor,0\n", .least_frames = 8},
    {.name = "swapchain_timeout", .faults = "4,swapchain_timeout,2\n"},
    {.name = "swapchain_timeout_that_stays",
     .faults = "4,swapchain_timeout,1000000\n",
     .says = "has no image free"},
    {.name = "session_pause", .faults = "4,session_pause,\n"},
    {.name = "exit", .faults = "4,exit,\n", .least_frames = 4, .most_frames = 6},
    {.name = "out_of_memory",
     .faults = "start,out_of_memory,xrCreateSwapchain\n",
     .exit_code = 3,
     .says = "xrCreateSwapchain failed with XR_ERROR_OUT_OF_MEMORY (end other programs",
     .least_frames = 0,
     .most_frames = 0},
    {.name = "image_refused",
     .faults = "4,fail,xrWaitSwapchainImage=XR_ERROR_RUNTIME_FAILURE\n",
     .exit_code = 3,
     .says = "xrWaitSwapchainImage failed with XR_ERROR_RUNTIME_FAILURE",
     .least_frames = 4,
     .most_frames = 4},
    {.name = "runtime_failure",
     .faults = "4,fail,xrWaitFrame=XR_ERROR_RUNTIME_FAILURE\n",
     .exit_code = 3,
     .says = "xrWaitFrame failed with XR_ERROR_RUNTIME_FAILURE (start the runtime anew",
     .least_frames = 4,
     .most_frames = 5},
    {.name = "session_refused",
     .faults = "start,fail,xrCreateSession=XR_ERROR_RUNTIME_FAILURE\n",
     .exit_code = 3,
     .says = "xrCreateSession failed with XR_ERROR_RUNTIME_FAILURE",
     .least_frames = 0,
     .most_frames = 0},
    {.name = "session_lost_at_once",
     .faults = "start,fail,xrCreateSwapchain=XR_ERROR_SESSION_LOST\n",
     .says = "connected to"},
    {.name = "new_session_refused_once",
     .faults = "4,fail,xrCreateSwapchain=XR_ERROR_OUT_OF_MEMORY\n4,session_loss,\n",
     .says = "XR_ERROR_OUT_OF_MEMORY (end other programs, or show a smaller scene); trying again",
     .least_frames = 10},
    {.name = "lost_again_and_again",
     .faults = "4,fail,xrWaitFrame=XR_ERROR_SESSION_LOST always\n",
     .exit_code = 3,
     .says = "error: OpenXR runtime: it lost the headset's session in xrWaitFrame",
     .least_frames = 4},
};

class FaultsTest : public testing::Test {
  protected:
    void write(const std::string& faults) {
        folder_.write("scene.json",
                      R"({"format":"foveray-scene","version":1,"environment":{"color":[0.2,0.2,0.2]}})");
        folder_.write("faults.csv", "at,fault,value\n" + faults);
    }
    std::string path(const char* name) const { return (folder_ / name).string(); }

    fakes::TemporaryFolder folder_;
    const fakes::Environment faults_{"FOVERAY_SIMULATOR_FAULTS", path("faults.csv")};
};

class ViewFaultsTest : public FaultsTest, public testing::WithParamInterface<Row> {};

TEST_P(ViewFaultsTest, EndsInTimeAndKeepsItsRecording) {
    const Row& row = GetParam();
    write(row.faults);
    Session script;
    script.rate_hz = 30;
    script.frames = 12;
    write_session(folder_ / "script", script);
    const fakes::Environment runtime("XR_RUNTIME_JSON", FOVERAY_SIMULATOR_JSON),
        session("FOVERAY_SIMULATOR_SESSION", path("script")), time("FOVERAY_SIMULATOR_TIME", "virtual");
    const auto viewed = fakes::run_foveray({"view", path("scene.json"), "--runtime", "system", "--record",
                                            path("recording"), "--set", "foveation.resolution_scale=0.1"},
                                           std::chrono::minutes(5));
    EXPECT_EQ(viewed.exit_code, row.exit_code) << viewed.err;
    EXPECT_NE(viewed.err.find(row.says), std::string::npos) << viewed.err;
    EXPECT_EQ(viewed.err.find("Validation"), std::string::npos) << viewed.err;
    if (row.most_frames == 0) {
        EXPECT_FALSE(std::filesystem::exists(path("recording")));
        return;
    }
    const Session recorded = read_session(path("recording"));
    EXPECT_GE(recorded.head.size(), row.least_frames) << viewed.err;
    EXPECT_LE(recorded.head.size(), row.most_frames) << viewed.err;
    EXPECT_GE(recorded.frames, recorded.head.size());
}

INSTANTIATE_TEST_SUITE_P(Faults, ViewFaultsTest, testing::ValuesIn(rows),
                         [](const auto& row) { return row.param.name; });

class ViewInterruptTest : public FaultsTest {
  protected:
    /// The exit code of Ctrl-C once it says that.
    int interrupt(const std::string& after) {
        fakes::RunningView view(folder_, {"--record", path("recording")}, fakes::RunningView::Pictures::Kept);
        view.wait_for(after);
        const auto start = std::chrono::steady_clock::now();
        const int code = view.end();
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)) << view.log();
        return code;
    }
};

TEST_F(ViewInterruptTest, EndsAtOnceWhileTheHeadsetIsLost) {
    write("4,form_factor_lost,\n4,session_loss,\n");
    EXPECT_EQ(interrupt("its headset is away"), 0);
    EXPECT_GE(read_session(path("recording")).head.size(), 1u);
}

TEST_F(ViewInterruptTest, EndsWhileItWaitsForAFrameThatDoesNotCome) {
    write("");
    const fakes::Environment time("FOVERAY_SIMULATOR_TIME", "stepped"),
        socket("FOVERAY_SIMULATOR_CONTROL", path("socket"));
    fakes::RunningView view(folder_, {"--record", path("recording")}, fakes::RunningView::Pictures::Kept);
    view.wait_for("Ctrl-C ends");
    std::this_thread::sleep_for(std::chrono::seconds(1));  // in xrWaitFrame, which nobody lets return
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(view.end(), 0) << view.log();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)) << view.log();
}

TEST_F(ViewInterruptTest, EndsAtOnceWhileTheHeadsetIsWaitedFor) {
    write("start,form_factor_lost,\n");
    EXPECT_EQ(interrupt("waiting for it"), 128 + SIGINT);
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
        EXPECT_EQ(entry.path().filename().string().find("recording"), std::string::npos) << entry.path();
}

}  // namespace
}  // namespace foveray
