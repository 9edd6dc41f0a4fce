#include "base/math.h"

#include <limits>

#include <gtest/gtest.h>

namespace foveray {
namespace {

void expect_near(vec3 a, vec3 b, float tolerance = 1e-5f) { EXPECT_LT(glm::length(a - b), tolerance); }

TEST(Pose, ComposesInvertsAndMatchesItsMatrix) {
    const Pose a{glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 3))), {1, -2, 3}};
    const Pose b{glm::angleAxis(-1.9f, glm::normalize(vec3(-3, 1, 0))), {0.5f, 4, -1}};
    const vec3 p(0.3f, -0.8f, 2.0f);
    expect_near(transform_point(a * b, p), transform_point(a, transform_point(b, p)));
    expect_near(transform_point(inverse(a), transform_point(a, p)), p);
    expect_near(transform_point(a, p), vec3(to_matrix(a) * vec4(p, 1)));
    expect_near(transform_direction(a, p), vec3(to_matrix(a) * vec4(p, 0)));
}

TEST(Pose, InterpolatesAlongTheShortWay) {
    const Pose from{glm::angleAxis(radians(350.0f), vec3(0, 1, 0)), {0, 0, 0}};
    const Pose to{glm::angleAxis(radians(10.0f), vec3(0, 1, 0)), {2, 0, 0}};
    const Pose middle = interpolate(from, to, 0.5f);
    expect_near(middle.position, {1, 0, 0});
    expect_near(transform_direction(middle, {0, 0, -1}), {0, 0, -1});
}

TEST(Pose, IsUnusableWithNanOrNoRotation) {
    EXPECT_TRUE(is_usable(Pose{}));
    EXPECT_FALSE(is_usable(Pose{quat(1, 0, 0, 0), {0, std::numeric_limits<float>::quiet_NaN(), 0}}));
    EXPECT_FALSE(is_usable(Pose{quat(0, 0, 0, 0), {}}));
}

}  // namespace
}  // namespace foveray
