// Headset profiles: those that ship, and what is wrong with others.
#include <cmath>

#include <gtest/gtest.h>

#include "base/headset_profile.h"
#include "base/json.h"
#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray {
namespace {

Json ci_profile() { return read_json(assets_folder() / "headsets" / "ci.json"); }

TEST(Profiles, AllThatShipLoad) {
    for (const char* name : {"varjo-xr1", "vive-pro-eye", "quest-pro", "valve-index", "ci", "ci-stereo"}) {
        const HeadsetProfile profile = read_headset_profile(name);
        EXPECT_EQ(profile.name, name);
        EXPECT_FALSE(profile.source.empty());
        ASSERT_GE(profile.views.size(), 2u);
        EXPECT_EQ(profile.views[0].fov.left, -profile.views[1].fov.right) << "the right eye mirrors the left";
        EXPECT_EQ(profile.views[1].eye, Eye::Right);
    }
}

TEST(Profiles, VarjoXr1IsAsPublished) {
    const HeadsetProfile profile = read_headset_profile("varjo-xr1");
    ASSERT_EQ(profile.views.size(), 4u);
    EXPECT_EQ(profile.rate_hz, 60.0);
    EXPECT_EQ(profile.views[0].size, uvec2(1980));
    EXPECT_FLOAT_EQ(profile.views[0].ppd, 22.0f);
    EXPECT_EQ(profile.views[2].role, ViewRole::Focus);
    EXPECT_EQ(profile.views[2].size, uvec2(2400, 1800));
    EXPECT_FLOAT_EQ(profile.views[2].ppd, 60.0f);
    EXPECT_FLOAT_EQ(degrees(profile.views[2].fov.right), 20.0f);
    EXPECT_FLOAT_EQ(profile.acuity.a, 200.0f);
    EXPECT_FLOAT_EQ(profile.acuity.cap_ppd, 60.0f);
}

TEST(Profiles, CiIsSmallYetFourTimesDenserAtTheGaze) {
    const Acuity acuity = read_headset_profile("ci").acuity;
    const double capped = acuity.a / acuity.cap_ppd - acuity.b;  // degrees out to which the cap holds
    const double radial = acuity.cap_ppd * capped +
                          acuity.a * std::log((acuity.outer_degrees + acuity.b) / (capped + acuity.b));
    const double samples = 2.0 * radial * radial * 0.9746;
    EXPECT_GT(samples, 30'000);
    EXPECT_LT(samples, 60'000);
    EXPECT_GE(acuity.cap_ppd / (acuity.a / (45.0f + acuity.b)), 4.0f);
}

TEST(Profiles, FaultsNameTheFileAndThePlace) {
    fakes::TemporaryFolder folder;
    const auto refused = [&](const Json& json, const std::string& part) {
        const auto file = folder.write("bad.json", json.dump());
        fakes::expect_fault([&] { read_headset_profile(file); }, ExitCode::BadInput, part);
        fakes::expect_fault([&] { read_headset_profile(file); }, ExitCode::BadInput, file);
    };
    Json json = ci_profile();
    json.erase("views");
    refused(json, "views");
    json = ci_profile();
    json["views"]["context"]["width"] = -1;
    refused(json, "/views/context/width");
    json = ci_profile();
    json["views"]["focus"]["fov_degrees"]["right"] = 60;
    refused(json, "/views/focus");
    json = ci_profile();
    json["views"]["context"]["fov_degrees"]["up"] = -50;
    refused(json, "/views/context");
    json = ci_profile();
    json["blend_modes"] = Json::array({"magic"});
    refused(json, "/blend_modes");
    json = ci_profile();
    json["hidden_outline"] = Json::array({{0, 0}, {0, 0.5}, {0.5, 0}});
    refused(json, "/hidden_outline");
    json = ci_profile();
    json["colour"] = "red";
    refused(json, "colour");

    folder.write("bad.json", "{\n\"format\": oops}");
    fakes::expect_fault([&] { read_headset_profile(folder.path() / "bad.json"); }, ExitCode::BadInput,
                        "bad.json:2");
    fakes::expect_fault([&] { read_headset_profile(folder.path() / "none.json"); }, ExitCode::BadInput,
                        "none.json");
    fakes::expect_fault([&] { read_headset_profile("varjo"); }, ExitCode::BadInput, "varjo-xr1");
    fakes::expect_fault([&] { read_headset_profile("../ci"); }, ExitCode::BadInput, "../ci");
}

TEST(Profiles, AssetsFolderCanBeNamed) {
    fakes::TemporaryFolder folder;
    setenv("FOVERAY_ASSETS", folder.path().c_str(), 1);
    EXPECT_EQ(assets_folder(), folder.path());
    setenv("FOVERAY_ASSETS", "/no/such/folder", 1);
    fakes::expect_fault([] { assets_folder(); }, ExitCode::BadInput, "FOVERAY_ASSETS");
    unsetenv("FOVERAY_ASSETS");
    EXPECT_TRUE(std::filesystem::is_directory(assets_folder() / "headsets"));
}

}  // namespace
}  // namespace foveray
