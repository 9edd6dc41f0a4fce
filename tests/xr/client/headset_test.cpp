// Our client against the simulated headset, through the real loader.
#include "xr/client/headset.h"

#include <chrono>
#include <cstdlib>
#include <optional>

#include <gtest/gtest.h>

#include "tests/fakes/expect_fault.h"
#include "tests/xr/client/headset_fixture.h"
#include "tests/xr/client/loader_spy.h"

namespace foveray::xr {
namespace {

TEST_F(HeadsetTest, FollowsTheScriptFromFirstFrameToExit) {
    const Played played = play(options());
    EXPECT_TRUE(played.ended);
    EXPECT_TRUE(played.messages.empty());
    ASSERT_EQ(played.frames.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        const Frame& frame = played.frames[i];
        EXPECT_EQ(frame.index, i);
        EXPECT_EQ(frame.time, static_cast<Nanoseconds>(i) * period);
        EXPECT_EQ(frame.period, period);
        EXPECT_TRUE(frame.head_valid);
        const Pose expected = session_.head_at(frame.time);
        EXPECT_LT(glm::length(frame.stage_from_head.position - expected.position), 1e-5f);
        EXPECT_LT(glm::angle(glm::conjugate(frame.stage_from_head.orientation) * expected.orientation),
                  1e-3f);
    }
}

TEST_F(HeadsetTest, SeesQuadViewsWithFocusInsideContext) {
    const Played played = play(options());
    for (const Frame& frame : played.frames) {
        ASSERT_EQ(frame.views.size(), 4u);
        for (int eye = 0; eye < 2; ++eye) {
            const View& context = frame.views[eye];
            const View& focus = frame.views[eye + 2];
            EXPECT_EQ(context.role, ViewRole::Context);
            EXPECT_EQ(focus.role, ViewRole::Focus);
            EXPECT_EQ(focus.stage_from_eye, context.stage_from_eye);
            EXPECT_GE(focus.fov.left, context.fov.left);
            EXPECT_LE(focus.fov.right, context.fov.right);
            EXPECT_GT(focus.size.x * focus.size.y, 0u);
        }
        const float ipd =
            glm::length(frame.views[1].stage_from_eye.position - frame.views[0].stage_from_eye.position);
        EXPECT_NEAR(ipd, 0.063f, 1e-5f);
    }
}

TEST_F(HeadsetTest, ReadsGazeBlinksAndControllers) {
    const Played played = play(options());
    ASSERT_EQ(played.frames.size(), 6u);
    for (const Frame& frame : played.frames) {
        EXPECT_TRUE(frame.has_eye_tracking);
        EXPECT_EQ(frame.gaze.valid, frame.index != 3) << frame.index;
        if (!frame.gaze.valid) continue;
        const vec3 expected =
            transform_direction(frame.stage_from_head, session_.gaze_at(frame.time).direction);
        EXPECT_LT(glm::length(frame.gaze.direction - expected), 1e-3f);
        EXPECT_EQ(frame.gaze.time - (frame.display_time - frame.time), session_.gaze_at(frame.time).time);
        EXPECT_FALSE(frame.controllers[0].valid);
        ASSERT_TRUE(frame.controllers[1].valid);
        EXPECT_TRUE(frame.controllers[1].primary_button);
        EXPECT_LT(glm::length(frame.controllers[1].stage_from_grip.position - vec3(0.3f, 1.0f, -0.4f)),
                  1e-5f);
    }
}

TEST_F(HeadsetTest, LivesThroughLostTrackingAndVisibilityAndEndsOnRequest) {
    session_.frames = 20;
    session_.events = {{2 * period, "head_tracking_lost", ""},
                       {4 * period, "head_tracking_gained", ""},
                       {6 * period, "visibility_lost", ""},
                       {9 * period, "visibility_gained", ""},
                       {14 * period, "exit", ""}};
    const Played played = play(options());
    EXPECT_TRUE(played.ended);
    EXPECT_LT(played.frames.size(), 20u);
    ASSERT_GT(played.frames.size(), 12u);
    EXPECT_FALSE(played.frames[3].head_valid);
    EXPECT_TRUE(played.frames[3].should_render) << "the last poses are held";
    EXPECT_EQ(played.frames[3].views[0].stage_from_eye, played.frames[1].views[0].stage_from_eye);
    EXPECT_EQ(played.frames[3].stage_from_head, played.frames[1].stage_from_head);
    bool hidden = false;
    for (const Frame& frame : played.frames) hidden = hidden || !frame.should_render;
    EXPECT_TRUE(hidden);
    EXPECT_TRUE(played.frames[12].should_render);
}

TEST_F(HeadsetTest, EndsWhenAskedTo) {
    SimulatorOptions simulator = options();
    simulator.session.clear();
    int shown = 0;
    const Played played = play(simulator, BlendMode::Opaque, [&](Headset& headset, auto&&...) {
        if (++shown == 3) headset.request_exit();
    });
    EXPECT_TRUE(played.ended);
    EXPECT_LT(played.frames.size(), 10u);
}

TEST_F(HeadsetTest, EndsWhenAskedToThoughTheRuntimeDoesNotAnswer) {
    SimulatorOptions simulator = options();
    simulator.session.clear();
    simulator.virtual_time = false;
    loader_spy::swallow_exit_requests(true);
    std::optional<Headset::Clock::time_point> asked;
    const Played played = play(simulator, BlendMode::Opaque, [&](Headset& headset, auto&&...) {
        if (asked) return;
        headset.request_exit();
        asked = Headset::Clock::now();
    });
    loader_spy::swallow_exit_requests(false);
    EXPECT_TRUE(played.ended);
    EXPECT_GT(played.frames.size(), 10u) << "it goes on meanwhile";
    ASSERT_TRUE(asked);
    EXPECT_LT(Headset::Clock::now() - *asked, std::chrono::seconds(20));
}

TEST_F(HeadsetTest, EndsAtOnceWhenAskedToBeforeTheRuntimeWantsFrames) {
    Headset headset(RuntimeChoice::Simulator, options());
    const gpu::Device device({.validation = true}, headset.device_source());
    const StopAtEnd stop_at_end(headset);
    headset.start(device, BlendMode::Opaque, 0.1f, 50.0f);
    headset.request_exit();
    EXPECT_EQ(headset.poll(), Headset::State::Ended);
}

TEST_F(HeadsetTest, ReadsTheVisibilityMaskAgainWhenItChanges) {
    session_.headset = "ci-stereo";
    session_.frames = 8;
    session_.events = {{2 * period, "visibility_mask_removed", ""},
                       {5 * period, "visibility_mask_restored", ""}};
    SimulatorOptions simulator = options();
    simulator.profile = "ci-stereo";
    std::vector<std::vector<HiddenMesh>> seen;
    play(simulator, BlendMode::Opaque,
         [&](Headset& headset, auto&&...) { seen.push_back(headset.hidden_meshes()); });
    ASSERT_EQ(seen.size(), 8u);
    for (std::size_t view = 0; view < 2; ++view) {
        // A change comes with the wait for a frame and is read before the next.
        const HiddenMesh &first = seen[0][view], &none = seen[4][view], &again = seen[6][view];
        EXPECT_FALSE(first.indices.empty());
        EXPECT_EQ(seen[2][view].version, first.version);
        EXPECT_TRUE(none.indices.empty() && none.vertices.empty());
        EXPECT_EQ(again.indices, first.indices);
        EXPECT_EQ(again.vertices, first.vertices);
        EXPECT_NE(none.version, first.version);
        EXPECT_NE(again.version, none.version);
        EXPECT_NE(again.version, first.version);
    }
}

TEST_F(HeadsetTest, DescribesItselfAsAProfile) {
    for (const std::string name : {"ci", "ci-stereo"}) {
        session_.headset = name;
        SimulatorOptions simulator = options();
        simulator.profile = name;
        HeadsetProfile found;
        play(simulator, BlendMode::Opaque,
             [&](Headset& headset, const gpu::Device&, gpu::FrameRing&, const Frame& frame, auto&&...) {
                 found = headset.profile(frame);
             });
        const HeadsetProfile truth = read_headset_profile(name);
        const std::filesystem::path file = folder_.path() / "headset.json";
        write_headset_profile(file, found);
        const HeadsetProfile read = read_headset_profile(file);
        EXPECT_EQ(read.display_name, truth.display_name);
        EXPECT_NEAR(read.rate_hz, session_.rate_hz, 1e-9);
        EXPECT_NEAR(read.ipd, truth.ipd, 1e-6f);
        EXPECT_EQ(read.eye_tracking, truth.eye_tracking);
        EXPECT_EQ(read.blend_modes, truth.blend_modes);
        EXPECT_NEAR(read.foveated_focus_scale, truth.foveated_focus_scale, 0.01f);
        ASSERT_EQ(read.views.size(), truth.views.size());
        for (std::size_t i = 0; i < truth.views.size(); ++i) {
            EXPECT_EQ(read.views[i].eye, truth.views[i].eye);
            EXPECT_EQ(read.views[i].role, truth.views[i].role);
            EXPECT_EQ(read.views[i].size, truth.views[i].size);
            EXPECT_NEAR(read.views[i].fov.left, truth.views[i].fov.left, 1e-6f);
            EXPECT_NEAR(read.views[i].fov.right, truth.views[i].fov.right, 1e-6f);
            EXPECT_NEAR(read.views[i].fov.up, truth.views[i].fov.up, 1e-6f);
            EXPECT_NEAR(read.views[i].fov.down, truth.views[i].fov.down, 1e-6f);
        }
    }
}

TEST_F(HeadsetTest, StereoHeadsetsHaveTwoViewsAndNoGaze) {
    SimulatorOptions simulator = options();
    simulator.profile = "valve-index";
    Headset headset(RuntimeChoice::Simulator, simulator);
    EXPECT_EQ(headset.instance().view_configuration(), XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
    EXPECT_FALSE(headset.instance().has_eye_tracking());
    EXPECT_TRUE(headset.is_simulator());
}

TEST_F(HeadsetTest, WithoutARuntimeAutoTakesTheSimulatorAndSystemSaysWhy) {
    const std::string none = (folder_.path() / "none.json").string();
    ::setenv("XR_RUNTIME_JSON", none.c_str(), 1);
    fakes::expect_fault([&] { Headset headset(RuntimeChoice::System, options()); }, ExitCode::Missing,
                        "OpenXR");
    ::setenv("XR_RUNTIME_JSON", none.c_str(), 1);
    Headset headset(RuntimeChoice::Auto, options());
    EXPECT_TRUE(headset.is_simulator());
}

TEST(RuntimeChoice, FindsTheSimulatorBesideTheProgram) {
    EXPECT_TRUE(std::filesystem::exists(simulator_manifest()));
    ::setenv("XR_RUNTIME_JSON", "/some/where.json", 1);
    EXPECT_EQ(system_runtime_manifest(), "/some/where.json");
    ::unsetenv("XR_RUNTIME_JSON");
}

}  // namespace
}  // namespace foveray::xr
