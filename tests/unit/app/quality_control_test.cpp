#include "app/quality_control.h"

#include <gtest/gtest.h>

namespace foveray::app {
namespace {

constexpr Nanoseconds period = 11'111'111;

Frame frame_at(std::uint64_t index, float yaw = 0.0f) {
    Frame frame;
    frame.index = index;
    frame.period = period;
    frame.time = static_cast<Nanoseconds>(index) * period;
    frame.head_valid = true;
    frame.stage_from_head.orientation = glm::angleAxis(yaw, vec3(0, 1, 0));
    return frame;
}

FrameMetrics metrics_of(std::uint64_t index, double gpu_ms) {
    FrameMetrics metrics;
    metrics.index = index;
    metrics.stages = {{"primary", 0.5 * gpu_ms}, {"lighting", 0.5 * gpu_ms}};
    return metrics;
}

/// What the last of `frames` frames was traced with, when full scale takes `full_ms` and a frame's times are
/// known two frames later.
Settings run(const Settings& wanted, std::uint64_t frames, double full_ms, float yaw_a_frame = 0.0f) {
    QualityControl control;
    std::vector<Settings> used;
    for (std::uint64_t i = 0; i < frames; ++i) {
        std::optional<FrameMetrics> newest;
        if (i >= 2) {
            const double scale = static_cast<double>(used[i - 2].resolution_scale / wanted.resolution_scale);
            newest = metrics_of(i - 2, full_ms * scale * scale);
        }
        used.push_back(control.choose(wanted, frame_at(i, static_cast<float>(i) * yaw_a_frame), newest));
    }
    return used.back();
}

Settings with_level_name(const std::string& level) {
    Settings s;
    s.quality_level = level;
    return s;
}

TEST(QualityControl, FramesFitTheShareOfThePeriod) {
    // 16 ms at full scale, 8.9 allowed: a scale of 0.745.
    EXPECT_FLOAT_EQ(run(with_level_name("manual"), 60, 16.0).resolution_scale, 0.6875f);
    EXPECT_FLOAT_EQ(run(with_level_name("manual"), 60, 2.0).resolution_scale, 1.0f);
    EXPECT_FLOAT_EQ(run(with_level_name("manual"), 60, 100.0).resolution_scale, 0.5f);
}

TEST(QualityControl, ScalesWhatTheUserSet) {
    Settings wanted = with_level_name("manual");
    wanted.resolution_scale = 1.5f;
    wanted.least_scale = 0.75f;
    EXPECT_FLOAT_EQ(run(wanted, 60, 100.0).resolution_scale, 1.125f);
}

TEST(QualityControl, ATurningHeadLowersTheScale) {
    EXPECT_LT(run(with_level_name("manual"), 60, 2.0, 0.03f).resolution_scale, 0.85f);
    EXPECT_FLOAT_EQ(run(with_level_name("manual"), 60, 2.0, 0.001f).resolution_scale, 1.0f);
}

TEST(QualityControl, WithoutALimitSettingsStay) {
    Settings wanted;
    wanted.gpu_share = 0.0f;
    const Settings used = run(wanted, 60, 100.0, 0.05f);
    EXPECT_EQ(used.resolution_scale, 1.0f);
    EXPECT_EQ(used.shadow_samples, wanted.shadow_samples);
}

TEST(QualityControl, AutomaticSpendsOnAStillHeadAndANamedLevelStays) {
    EXPECT_EQ(run(with_level_name("automatic"), 600, 1.0).shadow_samples, 64);
    EXPECT_LE(run(with_level_name("automatic"), 600, 1.0, 0.03f).shadow_samples, 4);
    EXPECT_EQ(run(with_level_name("high"), 600, 1.0, 0.03f).shadow_samples, 16);
    EXPECT_EQ(run(with_level_name("manual"), 600, 1.0).shadow_samples, Settings{}.shadow_samples);
}

TEST(QualityControl, AReplayFollowsTheRecording) {
    Session session;
    session.quality = {{100, 0.5f, 1, 1, 64, 1}, {200, 0.75f, 4, 2, 128, 2}};
    const Settings before = replay_settings({}, session, 99), first = replay_settings({}, session, 150),
                   second = replay_settings({}, session, 200);
    EXPECT_EQ(before.resolution_scale, 1.0f);
    EXPECT_EQ(first.resolution_scale, 0.5f);
    EXPECT_EQ(first.shadow_samples, 1);
    EXPECT_EQ(quality_sample(second, 200), session.quality[1]);

    Settings wanted;
    wanted.shadow_samples = 9;
    EXPECT_EQ(replay_settings(wanted, session, 150).shadow_samples, 9);
    EXPECT_EQ(replay_settings(wanted, session, 150).resolution_scale, 0.5f);
    EXPECT_EQ(replay_settings(with_level_name("manual"), session, 150).resolution_scale, 1.0f);
    EXPECT_EQ(replay_settings(with_level_name("best"), session, 150).shadow_samples, 64);
}

}  // namespace
}  // namespace foveray::app
