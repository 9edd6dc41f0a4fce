#include "app/commands.h"
#include "app/doctor/finding.h"
#include "base/json.h"
#include "tests/unit/app/temporary_folder.h"

namespace foveray::app {
namespace {

using State = Finding::State;

class Doctor : public TemporaryFolder {};

TEST_F(Doctor, ListsCamerasWithTheirNames) {
    write("dev/video1", "");
    write("dev/video0", "");
    write("dev/null", "");
    write("names/video0/name", "Left camera\n");
    const auto findings = find_cameras((folder_ / "dev").string(), (folder_ / "names").string());
    ASSERT_EQ(findings.size(), 2u);
    EXPECT_EQ(findings[0].state, State::Good);
    EXPECT_EQ(findings[0].subject, "Camera " + (folder_ / "dev/video0").string());
    EXPECT_EQ(findings[0].what, "Left camera");
}

TEST_F(Doctor, NoCameraIsNoObstacle) {
    const auto findings = find_cameras((folder_ / "nowhere").string(), "");
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].state, State::Optional);
    EXPECT_FALSE(findings[0].remedy.empty());
}

TEST_F(Doctor, JsonAgreesWithTheExitCode) {
    testing::internal::CaptureStdout();
    const ExitCode code = run_doctor({.json = true});
    const Json json = Json::parse(testing::internal::GetCapturedStdout());
    bool missing = false, vulkan = false;
    for (const Json& finding : json["findings"]) {
        missing |= finding["state"] == "missing";
        vulkan |= finding["subject"] == "Vulkan loader";
        if (finding["state"] == "missing") {
            EXPECT_TRUE(finding.contains("remedy")) << finding;
        }
    }
    EXPECT_TRUE(vulkan);
    EXPECT_EQ(json["can_run"].get<bool>(), !missing);
    EXPECT_EQ(code, missing ? ExitCode::Missing : ExitCode::Done);
}

}  // namespace
}  // namespace foveray::app
