#include <gtest/gtest.h>

#include "shaders/shared/ray_cone.h"

namespace foveray::shared {
namespace {

TEST(RayCone, TravelsInATMinThatMovesNothing) {
    for (float width = 1e-6f; width < 3.0f; width *= 1.37f) {
        for (float spread = 1e-6f; spread < 3.0f; spread *= 1.53f) {
            const float t_min = ray_cone_t_min({width, spread});
            EXPECT_GT(t_min, 0.0f);
            EXPECT_LT(t_min, 3e-10f);
            const RayCone cone = ray_cone_of(t_min);
            EXPECT_NEAR(cone.width, width, 0.0025f * width);
            EXPECT_NEAR(cone.spread, spread, 0.0025f * spread);
        }
    }
}

TEST(RayCone, EndsOfTheRange) {
    EXPECT_EQ(ray_cone_of(ray_cone_t_min({0.0f, 0.0f})).width, 0.0f);
    EXPECT_EQ(ray_cone_of(ray_cone_t_min({0.0f, 0.0f})).spread, 0.0f);
    EXPECT_NEAR(ray_cone_of(ray_cone_t_min({1000.0f, 1000.0f})).width, 4.0f, 0.01f);
    EXPECT_LT(ray_cone_t_min({1000.0f, 1000.0f}), 3e-10f);
}

}  // namespace
}  // namespace foveray::shared
