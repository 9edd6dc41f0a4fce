#include "base/session.h"

#include <gtest/gtest.h>

#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray {
namespace {

using fakes::expect_fault;

constexpr const char* head_header = "time_ns,px,py,pz,qx,qy,qz,qw\n";

std::string json(const std::string& streams, const std::string& more = "") {
    return R"({"format":"foveray-session","version":1,"headset":"ci","rate_hz":10,"frames":20,"recorded":[)" +
           streams + "]" + more + "}";
}

Session some_session() {
    Session s;
    s.headset = "varjo-xr1";
    s.rate_hz = 60;
    s.frames = 120;
    s.head = {{0, {quat(1, 0, 0, 0), {0, 1.5f, 0}}},
              {1'000'000'000, {glm::angleAxis(1.0f, vec3(0, 1, 0)), {1, 1.5f, 0}}}};
    s.gaze = {{100, true, {0, 0, 0}, {0, 0, -1}}, {200, false, {0, 0, 0}, {0, 0, -1}}};
    s.controllers = {
        {50, 1, {true, {quat(1, 0, 0, 0), {0.3f, 1, -0.2f}}, {}, 0.5f, 1.0f, {0.1f, -1}, true, false}}};
    s.controllers.front().state.stage_from_aim = s.controllers.front().state.stage_from_grip;
    s.events = {{700, "focus_lost", ""}, {900, "exit", "now"}};
    s.quality = {{0, 1.0f, 16, 1, 64, 1}, {500, 0.8125f, 1, 2, 128, 3}};
    return s;
}

TEST(Session, ReadsWhatItWrote) {
    const fakes::TemporaryFolder folder;
    Session s = some_session();
    s.scene = folder.path() / "scenes/a.json";
    write_session(folder.path() / "session", s);
    const Session back = read_session(folder.path() / "session");
    EXPECT_EQ(back.headset, s.headset);
    EXPECT_EQ(back.frames, 120u);
    EXPECT_EQ(back.duration(), 2'000'000'000);
    EXPECT_EQ(back.scene->lexically_normal(), s.scene->lexically_normal());
    ASSERT_EQ(back.head.size(), 2u);
    EXPECT_EQ(back.head[1].stage_from_head.position, s.head[1].stage_from_head.position);
    EXPECT_LT(glm::length(back.head[1].stage_from_head.orientation - s.head[1].stage_from_head.orientation),
              1e-6f);
    ASSERT_EQ(back.gaze.size(), 2u);
    EXPECT_TRUE(back.gaze[0].valid);
    EXPECT_FALSE(back.gaze[1].valid);
    ASSERT_EQ(back.controllers.size(), 1u);
    EXPECT_EQ(back.controllers[0].hand, 1);
    EXPECT_EQ(back.controllers[0].state.thumbstick, vec2(0.1f, -1));
    EXPECT_TRUE(back.controllers[0].state.primary_button);
    ASSERT_EQ(back.events.size(), 2u);
    EXPECT_EQ(back.events[1].name, "exit");
    EXPECT_EQ(back.events[1].value, "now");
    EXPECT_EQ(back.quality, s.quality);
}

TEST(Session, InterpolatesTheHeadAndHoldsTheGaze) {
    const Session s = some_session();
    EXPECT_EQ(s.head_at(-5).position, vec3(0, 1.5f, 0));
    EXPECT_LT(glm::length(s.head_at(250'000'000).position - vec3(0.25f, 1.5f, 0)), 1e-6f);
    EXPECT_NEAR(glm::angle(s.head_at(500'000'000).orientation), 0.5f, 1e-5f);
    EXPECT_EQ(s.head_at(9'000'000'000).position, vec3(1, 1.5f, 0));
    EXPECT_FALSE(s.gaze_at(99).valid);
    EXPECT_EQ(s.gaze_at(150).time, 100);
    EXPECT_EQ(s.gaze_at(5000).time, 200);
    EXPECT_FALSE(s.controller_at(1, 49).valid);
    EXPECT_TRUE(s.controller_at(1, 50).valid);
    EXPECT_FALSE(s.controller_at(0, 50).valid);
    EXPECT_FALSE(s.quality_at(-1));
    EXPECT_EQ(s.quality_at(499)->resolution_scale, 1.0f);
    EXPECT_EQ(s.quality_at(501)->shadow_samples, 1);
}

TEST(Session, RefusesQualityThatNoSettingTakes) {
    const fakes::TemporaryFolder folder;
    folder.write("session.json", json(R"("quality")"));
    const auto refuse = [&](const std::string& row, const std::string& part) {
        folder.write("quality.csv",
                     "time_ns,resolution_scale,shadow_samples,ambient_occlusion_samples,probe_rays,"
                     "second_ray_depth\n" +
                         row + "\n");
        expect_fault([&] { read_session(folder.path()); }, ExitCode::BadInput, part);
    };
    refuse("0,0,4,1,64,1", "resolution_scale");
    refuse("0,1,400,1,64,1", "shadow_samples is 400");
    refuse("0,1,4,1,4,1", "use 16 to 256");
    refuse("0,1,4,1,64,0", "second_ray_depth");
}

TEST(Session, RefusesBadFilesWithFileAndLine) {
    const fakes::TemporaryFolder folder;
    const auto refuse = [&](const std::string& session, const std::string& head, const std::string& part) {
        folder.write("session.json", session);
        folder.write("head.csv", head);
        expect_fault([&] { read_session(folder.path()); }, ExitCode::BadInput, part);
    };
    expect_fault([&] { read_session(folder.path() / "none"); }, ExitCode::BadInput,
                 "is not a session folder");
    expect_fault([&] { read_session(folder.path()); }, ExitCode::BadInput, "session.json");
    const std::string good = std::string(head_header) + "0,0,1,0,0,0,0,1\n";
    refuse("{", good, "session.json:1");
    refuse(R"({"format":"other"})", good, "/format");
    refuse(R"({"format":"foveray-session","version":9})", good, "/version");
    refuse(json(R"("feet")"), good, "unknown stream 'feet'");
    refuse(json(R"("gaze")"), good, "gaze.csv");
    refuse(json(R"("head")"), std::string(head_header) + "0,0,nan,0,0,0,0,1\n", "head.csv:2");
    refuse(json(R"("head")"), std::string(head_header) + "0,0,1,0,0,0,0,0\n", "quaternion");
    refuse(json(R"("head")"), std::string(head_header) + "5,0,1,0,0,0,0,1\n4,0,1,0,0,0,0,1\n", "head.csv:3");
    folder.write("gaze.csv", "time_ns,valid,ox,oy,oz,dx,dy,dz\n0,1,0,0,0,0,0,0\n");
    refuse(json(R"("gaze")"), good, "gaze.csv:2");
    refuse(R"({"format":"foveray-session","version":1,"headset":"ci","rate_hz":-1,"frames":3,"recorded":[]})",
           good, "/rate_hz");
    refuse(R"({"format":"foveray-session","version":1,"headset":3,"rate_hz":1,"frames":3,"recorded":[]})",
           good, "session.json");
}

}  // namespace
}  // namespace foveray
