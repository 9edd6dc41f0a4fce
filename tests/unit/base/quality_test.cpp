#include "base/quality.h"

#include <gtest/gtest.h>

namespace foveray {
namespace {

TEST(Quality, LevelsSpendMoreStepByStep) {
    int shadow = 0, occlusion = 0, rays = 0, depth = 0;
    for (const char* name : {"low", "medium", "high", "best"}) {
        Settings s;
        set(s, std::string("quality.level=") + name);
        ASSERT_TRUE(named_level(s)) << name;
        s = with_level(s, *named_level(s));
        EXPECT_GT(s.shadow_samples, shadow) << name;
        EXPECT_GE(s.ambient_occlusion_samples, std::max(occlusion, 1)) << name;
        EXPECT_GT(s.probe_rays, rays) << name;
        EXPECT_GE(s.second_ray_depth, std::max(depth, 1)) << name;
        shadow = s.shadow_samples, occlusion = s.ambient_occlusion_samples;
        rays = s.probe_rays, depth = s.second_ray_depth;
    }
}

TEST(Quality, LevelsAreWithinTheSettingsRanges) {
    const auto level = static_cast<QualityLevel>(3);
    const Settings best = with_level(Settings{}, level);
    for (const SettingInfo& info : settings_table()) {
        Settings copy;
        EXPECT_NO_THROW(set(copy, std::string(info.key) + "=" + value_text(best, info))) << info.key;
    }
}

TEST(Quality, WhatTheUserSetStays) {
    Settings s;
    s.shadow_samples = 7;
    s.probe_rays = 48;
    const Settings low = with_level(s, QualityLevel::Low);
    EXPECT_EQ(low.shadow_samples, 7);
    EXPECT_EQ(low.probe_rays, 48);
    EXPECT_EQ(low.second_ray_depth, 1);
}

TEST(Quality, SamplesOfALevelLeaveWhatThePictureShows) {
    const Settings best = with_samples_of(Settings{}, QualityLevel::Best);
    EXPECT_EQ(best.shadow_samples, 64);
    EXPECT_EQ(best.second_ray_depth, Settings{}.second_ray_depth);
    EXPECT_EQ(best.probe_rays, Settings{}.probe_rays);
}

TEST(Quality, ManualAndAutomaticNameNoLevel) {
    Settings s;
    EXPECT_FALSE(named_level(s));
    s.quality_level = "manual";
    EXPECT_FALSE(named_level(s));
}

}  // namespace
}  // namespace foveray
