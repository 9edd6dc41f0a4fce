// `foveray view --record`: on a runtime's own headset, and when an error ends it.
#include <gtest/gtest.h>

#include "base/headset_profile.h"
#include "base/image.h"
#include "base/session.h"
#include "tests/demo/run_program.h"
#include "tests/fakes/environment.h"

namespace foveray {
namespace {

namespace fs = std::filesystem;

class RecordingTest : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    const std::string scene_ = (assets_folder() / "scenes/primitives.json").string();
    fakes::TemporaryFolder folder_;
};

TEST_F(RecordingTest, KeepsTheViewsOfARuntimesOwnHeadset) {
    // The simulated headset again, but as the system's runtime: foveray knows no profile of it.
    Session script;
    script.headset = "ci-stereo";
    script.rate_hz = 20;
    script.frames = 3;
    script.head = {{0, {glm::angleAxis(0.2f, vec3(0, 1, 0)), {0, 1.6f, 0}}}};
    write_session(folder_ / "script", script);
    {
        const fakes::Environment runtime("XR_RUNTIME_JSON", FOVERAY_SIMULATOR_JSON),
            session("FOVERAY_SIMULATOR_SESSION", path("script")), time("FOVERAY_SIMULATOR_TIME", "virtual");
        const auto viewed =
            fakes::run_foveray({"view", scene_, "--runtime", "system", "--record", path("recording")});
        ASSERT_EQ(viewed.exit_code, 0) << viewed.err;
    }
    const Session recorded = read_session(folder_ / "recording");
    EXPECT_EQ(recorded.headset, path("recording/headset.json"));
    EXPECT_EQ(recorded.frames, 3u);
    const HeadsetProfile truth = read_headset_profile("ci-stereo"),
                         found = read_headset_profile(recorded.headset);
    EXPECT_EQ(found.display_name, truth.display_name);
    ASSERT_EQ(found.views.size(), truth.views.size());
    for (std::size_t i = 0; i < truth.views.size(); ++i) {
        EXPECT_EQ(found.views[i].size, truth.views[i].size);
        EXPECT_NEAR(found.views[i].fov.left, truth.views[i].fov.left, 1e-6f);
        EXPECT_NEAR(found.views[i].fov.down, truth.views[i].fov.down, 1e-6f);
    }
    EXPECT_GT(found.acuity.cap_ppd, 1.0f);

    // The folder can be moved, and its replay has the same views.
    fs::rename(folder_ / "recording", folder_ / "moved");
    const auto replayed = fakes::run_foveray(
        {"replay", path("moved"), "--scene", scene_, "--frames", "0:1", "--out", path("out")});
    ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
    for (std::size_t i = 0; i < truth.views.size(); ++i) {
        const Image shown = read_image(path("out/frames/frame_00000_view" + std::to_string(i) + ".png"), 3);
        EXPECT_EQ(uvec2(shown.width, shown.height), truth.views[i].size);
    }
}

TEST_F(RecordingTest, KeepsWhatWasRecordedWhenTheCameraBreaks) {
    fs::create_directories(folder_ / "camera");
    for (int i = 0; i < 3; ++i) write_png(path("camera/" + std::to_string(i) + ".png"), Image(16, 16, 3));
    folder_.write("camera/3.png", "no picture");
    folder_.write("camera/frames.csv",
                  "time_ns,file\n0,0.png\n100000000,1.png\n500000000,2.png\n1500000000,3.png\n");
    const auto viewed = fakes::run_foveray({"view", scene_, "--runtime", "simulator", "--camera",
                                            path("camera"), "--record", path("recording")});
    EXPECT_EQ(viewed.exit_code, 2) << viewed.err;
    EXPECT_NE(viewed.err.find("3.png"), std::string::npos) << viewed.err;
    EXPECT_EQ(viewed.err.find("Validation"), std::string::npos) << viewed.err;
    const Session recorded = read_session(folder_ / "recording");
    EXPECT_EQ(recorded.headset, "ci");
    EXPECT_GT(recorded.frames, 1u);
    EXPECT_FALSE(recorded.head.empty());
}

}  // namespace
}  // namespace foveray
