#include "base/settings.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/fakes/expect_fault.h"

namespace foveray {
namespace {

using fakes::expect_fault;

TEST(Settings, EveryKindOfValueIsSetAndWritten) {
    Settings s;
    set(s, "lighting.shadow_samples=16");
    set(s, "foveation.resolution_scale=0.5");
    set(s, "lighting.reflections=off");
    set(s, "resolve.filter=bilinear");
    EXPECT_EQ(s.shadow_samples, 16);
    EXPECT_EQ(s.resolution_scale, 0.5f);
    EXPECT_FALSE(s.reflections);
    EXPECT_EQ(s.resolve_filter, "bilinear");
    for (const SettingInfo& info : settings_table()) {
        Settings copy = s;
        EXPECT_NO_THROW(set(copy, std::string(info.key) + "=" + value_text(s, info))) << info.key;
    }
}

TEST(Settings, NumbersInJsonAreAsShortAsTheyReadBack) {
    const auto text = [](std::string_view key) {
        const auto table = settings_table();
        return value_json(Settings{}, *std::ranges::find(table, key, &SettingInfo::key)).dump();
    };
    EXPECT_EQ(text("foveation.angular_ratio"), "0.9746");
    EXPECT_EQ(text("lighting.shadow_samples"), std::to_string(Settings{}.shadow_samples));
    EXPECT_EQ(text("lighting.shadows"), "true");
    EXPECT_EQ(text("resolve.filter"), "\"bicubic\"");
}

TEST(Settings, KeysAreUniqueAndDefaultsAreInRange) {
    std::set<std::string_view> keys;
    for (const SettingInfo& info : settings_table()) {
        EXPECT_TRUE(keys.insert(info.key).second) << info.key;
        EXPECT_FALSE(info.help.empty());
    }
}

TEST(Settings, RefusalsNameKeyAndRemedy) {
    Settings s;
    const auto refuse = [&](const char* assignment, const char* part) {
        expect_fault([&] { set(s, assignment); }, ExitCode::BadInput, part);
    };
    refuse("lighting.shadow_samples", "has no '='");
    refuse("lighting.shadow_sample=3", "did you mean lighting.shadow_samples");
    refuse("lighting.shadow_samples=0", "between 1 and 256");
    refuse("lighting.shadow_samples=4.5", "whole number");
    refuse("foveation.resolution_scale=nan", "a number between");
    refuse("lighting.shadows=maybe", "on or off");
    refuse("resolve.filter=sharp", "one of bilinear bicubic");
}

}  // namespace
}  // namespace foveray
