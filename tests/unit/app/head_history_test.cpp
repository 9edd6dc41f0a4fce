#include "app/head_history.h"

#include <gtest/gtest.h>

namespace foveray::app {
namespace {

TEST(HeadHistory, InterpolatesAndHoldsAtItsEnds) {
    HeadHistory history;
    EXPECT_EQ(history.at(5), Pose{});
    history.add(0, {quat(1, 0, 0, 0), {0, 1, 0}});
    history.add(100, {quat(1, 0, 0, 0), {1, 1, 0}});
    EXPECT_EQ(history.at(-7).position, vec3(0, 1, 0));
    EXPECT_EQ(history.at(25).position, vec3(0.25f, 1, 0));
    EXPECT_EQ(history.at(100).position, vec3(1, 1, 0));
    EXPECT_EQ(history.at(900).position, vec3(1, 1, 0));
}

TEST(HeadHistory, ForgetsWhatIsOlderThanASecond) {
    HeadHistory history;
    for (int i = 0; i <= 40; ++i) {
        history.add(i * 100 * nanoseconds_per_millisecond, {quat(1, 0, 0, 0), {static_cast<float>(i), 0, 0}});
    }
    EXPECT_EQ(history.at(0).position.x, 30.0f);
    EXPECT_EQ(history.at(3500 * nanoseconds_per_millisecond).position.x, 35.0f);
}

}  // namespace
}  // namespace foveray::app
