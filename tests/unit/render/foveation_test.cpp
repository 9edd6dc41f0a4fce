#include "render/foveation.h"

#include <cmath>

#include <gtest/gtest.h>

namespace foveray::render {
namespace {

const vec3 forward(0.0f, 0.0f, -1.0f);
const vec3 aside = glm::normalize(vec3(0.3f, 0.1f, -1.0f));

float angle_degrees(vec3 a, vec3 b) {
    return degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// Frames of 10 ms, one after the other.
class FoveationTest : public testing::Test {
  protected:
    Fovea next(bool valid, vec3 direction = aside) {
        frame.time += 10 * nanoseconds_per_millisecond;
        frame.gaze = {frame.time, valid, vec3(0.0f, 1.6f, 0.0f), direction};
        return foveation.update(frame, settings);
    }
    Fovea after(int milliseconds, bool valid) {
        Fovea fovea;
        for (int t = 0; t < milliseconds; t += 10) fovea = next(valid);
        return fovea;
    }

    Foveation foveation;
    Settings settings;
    Frame frame = [] {
        Frame f;
        f.has_eye_tracking = true;
        f.head_valid = true;
        f.stage_from_head.position = {0.0f, 1.6f, 0.0f};
        return f;
    }();
};

TEST_F(FoveationTest, FollowsAValidGazeFromTheFirstFrame) {
    const Fovea fovea = next(true);
    EXPECT_TRUE(fovea.follows_gaze);
    EXPECT_LT(angle_degrees(fovea.direction, aside), 1e-3f);
    EXPECT_EQ(fovea.radius_degrees, 0.0f);
    const vec3 other = glm::normalize(vec3(-0.4f, 0.0f, -1.0f));
    EXPECT_LT(angle_degrees(next(true, other).direction, other), 1e-3f);
}

TEST_F(FoveationTest, HoldsThroughABlink) {
    next(true);
    for (int t = 10; t <= 200; t += 10) {
        const Fovea fovea = next(false, forward);
        EXPECT_FALSE(fovea.follows_gaze);
        EXPECT_LT(angle_degrees(fovea.direction, aside), 1e-3f) << t << " ms";
        EXPECT_EQ(fovea.radius_degrees, 0.0f) << t << " ms";
    }
    EXPECT_LT(angle_degrees(next(true).direction, aside), 1e-3f);
}

TEST_F(FoveationTest, EasesToTheFixedCentreAfterTheHold) {
    next(true);
    const float whole = angle_degrees(aside, forward);
    after(200, false);
    float last = whole;
    for (int t = 10; t < 200; t += 10) {
        const Fovea fovea = next(false);
        const float left = angle_degrees(fovea.direction, forward);
        const float x = static_cast<float>(t) / 200.0f;
        const float expected = whole * (1.0f - x * x * (3.0f - 2.0f * x));
        EXPECT_NEAR(left, expected, 0.02f) << t << " ms";
        EXPECT_NEAR(fovea.radius_degrees, settings.fixed_fovea_degrees * (1.0f - left / whole), 0.02f);
        EXPECT_LT(left, last);
        last = left;
    }
    const Fovea fixed = next(false);
    EXPECT_LT(angle_degrees(fixed.direction, forward), 1e-3f);
    EXPECT_FLOAT_EQ(fixed.radius_degrees, settings.fixed_fovea_degrees);
}

TEST_F(FoveationTest, EasesBackFasterWhenTheGazeReturns) {
    next(true);
    after(600, false);
    const Fovea first = next(true);
    EXPECT_FALSE(first.follows_gaze);
    EXPECT_GT(angle_degrees(first.direction, aside), 1.0f);
    const Fovea back = after(70, true);
    EXPECT_TRUE(back.follows_gaze);
    EXPECT_LT(angle_degrees(back.direction, aside), 1e-3f);
    EXPECT_EQ(back.radius_degrees, 0.0f);
}

TEST_F(FoveationTest, OneLongFrameEndsWhereManyShortOnesDo) {
    next(true);
    frame.time += 290 * nanoseconds_per_millisecond;
    const Fovea long_step = next(false);  // 300 ms: 100 ms past the hold
    EXPECT_NEAR(long_step.radius_degrees, 0.5f * settings.fixed_fovea_degrees, 1e-3f);
}

TEST_F(FoveationTest, HeldGazeTurnsWithTheHead) {
    next(true, forward);
    frame.stage_from_head.orientation = glm::angleAxis(radians(30.0f), vec3(0.0f, 1.0f, 0.0f));
    const Fovea fovea = next(false);
    EXPECT_LT(angle_degrees(fovea.direction, frame.stage_from_head.orientation * forward), 1e-3f);
}

TEST_F(FoveationTest, WithoutEyeTrackingTheFoveaIsFixedAndWide) {
    frame.has_eye_tracking = false;
    frame.stage_from_head.orientation = glm::angleAxis(radians(-20.0f), vec3(1.0f, 0.0f, 0.0f));
    const Fovea fovea = next(true);  // a gaze that is not tracked means nothing
    EXPECT_FALSE(fovea.follows_gaze);
    EXPECT_LT(angle_degrees(fovea.direction, frame.stage_from_head.orientation * forward), 1e-3f);
    EXPECT_FLOAT_EQ(fovea.radius_degrees, settings.fixed_fovea_degrees);
    EXPECT_EQ(fovea.origin, frame.stage_from_head.position);
}

TEST_F(FoveationTest, SwitchingTrackingOffEasesAway) {
    next(true);
    settings.gaze_tracking = false;
    const Fovea first = next(true);
    EXPECT_GT(first.radius_degrees, 0.0f);
    EXPECT_LT(first.radius_degrees, 1.0f);
    EXPECT_FLOAT_EQ(after(200, true).radius_degrees, settings.fixed_fovea_degrees);
}

}  // namespace
}  // namespace foveray::render
