#include "render/rebuild_plan.h"

#include <numeric>

#include <gtest/gtest.h>

namespace foveray::render {
namespace {

constexpr std::uint32_t large = 200'000;  // primitives: two of them are more than a frame's budget

TEST(RebuildPlan, FewPrimitivesAreRebuiltEveryTime) {
    RebuildPlan plan({1, RebuildPlan::always_rebuilt});
    const std::vector<std::uint8_t> changed = {1, 1};
    for (int frame = 0; frame < 5; ++frame) EXPECT_EQ(plan.choose(changed), (std::vector{true, true}));
}

TEST(RebuildPlan, WhatHasNotChangedIsLeftAlone) {
    RebuildPlan plan({1, 1000});
    const std::vector<std::uint8_t> changed = {0, 0};
    EXPECT_EQ(plan.choose(changed), (std::vector{false, false}));
}

TEST(RebuildPlan, LargeStructuresAreRefittedUntilABuildIsTheCheaper) {
    RebuildPlan plan({1000});
    const std::vector<std::uint8_t> changed = {1};
    const std::uint32_t refits = RebuildPlan::refits_between_builds(1000);
    EXPECT_GT(refits, 8u);
    EXPECT_LT(refits, RebuildPlan::refits_between_builds(1'000'000));
    for (std::uint32_t frame = 0; frame < 3 * (refits + 1); ++frame) {
        EXPECT_EQ(plan.choose(changed)[0], frame % (refits + 1) == 0) << frame;
    }
}

TEST(RebuildPlan, LargeStructuresTakeTurnsAndNoneIsForgotten) {
    constexpr std::size_t count = 12;
    RebuildPlan plan(std::vector<std::uint32_t>(count, large));
    const std::vector<std::uint8_t> changed(count, 1);
    std::vector<std::uint32_t> last(count, 0), rebuilt(count, 0);
    const std::uint32_t refits = RebuildPlan::refits_between_builds(large);
    for (std::uint32_t frame = 0; frame < 200; ++frame) {
        const std::vector<bool> rebuild = plan.choose(changed);
        EXPECT_LE(std::accumulate(rebuild.begin(), rebuild.end(), 0), 1) << frame;
        for (std::size_t i = 0; i < count; ++i) {
            if (!rebuild[i]) continue;
            EXPECT_LE(frame - last[i], refits + count) << i;
            last[i] = frame;
            ++rebuilt[i];
        }
    }
    for (std::size_t i = 0; i < count; ++i) EXPECT_GE(rebuilt[i], 5u) << i;
}

TEST(RebuildPlan, WhatIsLargerThanTheBudgetIsRebuiltAlone) {
    RebuildPlan plan({static_cast<std::uint32_t>(4 * RebuildPlan::frame_budget), 1000});
    const std::vector<std::uint8_t> changed = {1, 1};
    const std::vector<bool> first = plan.choose(changed), second = plan.choose(changed);
    EXPECT_EQ(first, (std::vector{true, false}));
    EXPECT_EQ(second, (std::vector{false, true}));
}

}  // namespace
}  // namespace foveray::render
