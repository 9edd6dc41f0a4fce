// Our client against the simulated headset, through the real loader.
#include "xr/client/headset.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "base/image.h"
#include "base/session.h"
#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray::xr {
namespace {

constexpr Nanoseconds period = 100'000'000;

class HeadsetTest : public testing::Test {
  protected:
    void SetUp() override {
        session_.headset = "ci";
        session_.rate_hz = 10;
        session_.frames = 6;
        session_.head = {{0, {quat(1, 0, 0, 0), {0, 1.5f, 0}}},
                         {5 * period, {glm::angleAxis(0.5f, vec3(0, 1, 0)), {0.5f, 1.5f, 0}}}};
        const vec3 aside = glm::normalize(vec3(0.2f, -0.1f, -1));
        session_.gaze = {{0, true, {}, aside}, {3 * period, false, {}, aside}, {4 * period, true, {}, aside}};
        ControllerState hand;
        hand.valid = true;
        hand.trigger = 1.0f;  // the profile's controller has only select, which the trigger presses
        hand.stage_from_grip.position = {0.3f, 1.0f, -0.4f};
        hand.stage_from_aim = hand.stage_from_grip;
        session_.controllers = {{0, 1, hand}};
    }
    void TearDown() override { ::unsetenv("XR_RUNTIME_JSON"); }

    SimulatorOptions options() {
        write_session(folder_.path() / "session", session_);
        SimulatorOptions simulator;
        simulator.session = folder_.path() / "session";
        simulator.virtual_time = true;
        return simulator;
    }

    struct Played {
        std::vector<Frame> frames;
        bool ended = false;
        std::vector<std::string> messages;
    };
    /// Plays to the end. `each` may record a submission.
    template <typename Each>
    Played play(const SimulatorOptions& simulator, BlendMode blend, Each each) {
        Played played;
        Headset headset(RuntimeChoice::Simulator, simulator);
        const gpu::Device device({.validation = true}, headset.device_source());
        headset.start(device, blend, 0.1f, 50.0f);
        std::vector<gpu::Buffer> buffers;  // the submission's
        gpu::FrameRing ring(device, 1);
        for (int turns = 0; turns < 1000; ++turns) {
            const Headset::State state = headset.poll();
            played.ended = state == Headset::State::Ended;
            if (played.ended) break;
            if (state == Headset::State::Waiting) continue;
            const Frame frame = headset.begin_frame();
            if (frame.should_render) each(headset, device, ring, frame, buffers);
            headset.end_frame(frame);
            played.frames.push_back(frame);
        }
        ring.wait();
        headset.stop();
        played.messages = device.validation_messages();
        return played;
    }
    Played play(const SimulatorOptions& simulator) {
        return play(simulator, BlendMode::Opaque, [](auto&&...) {});
    }

    fakes::TemporaryFolder folder_;
    Session session_;
};

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

TEST_F(HeadsetTest, ShowsWhatWasSubmitted) {
    SimulatorOptions simulator = options();
    simulator.capture = folder_.path() / "shown";
    simulator.capture_frames = {2, 3};
    const Played played = play(
        simulator, BlendMode::Opaque,
        [&](Headset& headset, const gpu::Device& device, gpu::FrameRing& ring, const Frame& frame,
            std::vector<gpu::Buffer>& kept) {
            const gpu::Commands cmd = ring.begin();
            kept.clear();
            std::vector<ViewPicture> pictures;
            for (std::size_t i = 0; i < frame.views.size(); ++i) {
                const vk::DeviceSize size = vk::DeviceSize{4} * frame.views[i].size.x * frame.views[i].size.y;
                kept.emplace_back(device, "colour", size, gpu::Residence::Device);
                kept.emplace_back(device, "depth", size, gpu::Residence::Device);
            }
            for (std::size_t i = 0; i < frame.views.size(); ++i) {
                const std::uint32_t color = 0xFF000000u | (40u * static_cast<std::uint32_t>(i) + 30u);
                cmd->fillBuffer(kept[2 * i].vk(), 0, VK_WHOLE_SIZE, color);
                cmd->fillBuffer(kept[2 * i + 1].vk(), 0, VK_WHOLE_SIZE, 0x3F000000u);
                pictures.push_back({kept[2 * i].vk(), 0, kept[2 * i + 1].vk(), 0});
            }
            cmd.barrier(gpu::Access::TransferWrite, gpu::Access::TransferRead);
            headset.record_submission(cmd, frame, pictures);
            ring.submit();
        });
    EXPECT_TRUE(played.messages.empty()) << played.messages.front();
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Image shown =
            read_image(simulator.capture / ("frame_00002_view" + std::to_string(i) + ".png"), 3);
        EXPECT_EQ(uvec2(shown.width, shown.height), played.frames[2].views[i].size);
        EXPECT_EQ(*shown.at(shown.width / 2, shown.height / 2), 40 * i + 30);
    }
    EXPECT_FALSE(std::filesystem::exists(simulator.capture / "frame_00001_view0.png"));
    EXPECT_TRUE(std::filesystem::exists(simulator.capture / "frame_00002_left.png"));
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
