#include "base/view.h"

#include <cmath>

#include <gtest/gtest.h>

namespace foveray {
namespace {

constexpr Fov lopsided{-0.9f, 0.6f, 0.5f, -0.8f};

TEST(View, CornersLieAtTheHalfAngles) {
    const vec3 top_left = direction_at(lopsided, {0, 0}), bottom_right = direction_at(lopsided, {1, 1});
    EXPECT_NEAR(std::atan(top_left.x), lopsided.left, 1e-6f);
    EXPECT_NEAR(std::atan(top_left.y), lopsided.up, 1e-6f);
    EXPECT_NEAR(std::atan(bottom_right.x), lopsided.right, 1e-6f);
    EXPECT_NEAR(std::atan(bottom_right.y), lopsided.down, 1e-6f);
}

TEST(View, DirectionAndPositionAreInverse) {
    for (const vec2 uv : {vec2(0.1f, 0.9f), vec2(0.5f, 0.5f), vec2(0.99f, 0.01f)}) {
        EXPECT_LT(glm::length(uv_of(lopsided, 3.0f * direction_at(lopsided, uv)) - uv), 1e-6f);
    }
}

TEST(View, ProjectionAgreesWithDirections) {
    const mat4 clip = clip_from_eye(lopsided, 0.1f, 50.0f);
    const vec2 uv(0.2f, 0.7f);
    const vec4 p = clip * vec4(direction_at(lopsided, uv) * 4.0f, 1.0f);
    EXPECT_NEAR(p.x / p.w * 0.5f + 0.5f, uv.x, 1e-5f);
    EXPECT_NEAR(p.y / p.w * 0.5f + 0.5f, uv.y, 1e-5f);
    const auto depth = [&](float z) {
        const vec4 q = clip * vec4(0, 0, z, 1);
        return q.z / q.w;
    };
    EXPECT_NEAR(depth(-0.1f), 0.0f, 1e-6f);
    EXPECT_NEAR(depth(-50.0f), 1.0f, 1e-5f);
}

}  // namespace
}  // namespace foveray
