#include <cmath>

#include "app/command_line.h"
#include "app/import/vive_pro_eye.h"
#include "base/error.h"
#include "tests/unit/app/temporary_folder.h"

namespace foveray::app {
namespace {

namespace fs = std::filesystem;

const std::string gaze_header =
    "time,ori_x,ori_y,ori_z,dir_x,dir_y,dir_z,gaze_x,gaze_y,gaze_z,gaze_object,pupil_l,pupil_r\n";
const std::string move_header =
    "time,head_pos_x,head_pos_y,head_pos_z,head_rot_x,head_rot_y,head_rot_z,left_pos_x,left_pos_y,left_pos_z,"
    "left_rot_x,left_rot_y,left_rot_z,right_pos_x,right_pos_y,right_pos_z,right_rot_x,right_rot_y,right_rot_"
    "z,"
    "grab_force,grab,trigger\n";

void expect_near(vec3 actual, vec3 expected, float tolerance = 1e-6f) {
    EXPECT_LT(glm::distance(actual, expected), tolerance)
        << actual.x << ' ' << actual.y << ' ' << actual.z << " is not " << expected.x << ' ' << expected.y
        << ' ' << expected.z;
}

class ViveProEye : public TemporaryFolder {
  protected:
    Session import(const std::string& gaze_rows, const std::string& move_rows) const {
        return read_vive_pro_eye(
            {write("VR_move.csv", move_header + move_rows), write("gaze.csv", gaze_header + gaze_rows)});
    }
    std::string message_of(const std::vector<fs::path>& files) const {
        try {
            read_vive_pro_eye(files);
        } catch (const Fault& fault) {
            EXPECT_EQ(fault.code(), ExitCode::BadInput);
            return fault.what();
        }
        return "";
    }
};

/// Unity's rotations written out: +z forward, +x right, +y up, left-handed, so that positive yaw turns right,
/// positive pitch looks down and positive roll leans left.
TEST(UnityEuler, TurnsAsUnityDoes) {
    const float s = std::sqrt(0.5f);
    const vec3 forward(0, 0, -1), up(0, 1, 0);
    expect_near(from_unity_euler({0, 0, 0}) * forward, forward);
    expect_near(from_unity_euler({0, 90, 0}) * forward, {1, 0, 0});
    expect_near(from_unity_euler({0, -45, 0}) * forward, {-s, 0, -s});
    expect_near(from_unity_euler({90, 0, 0}) * forward, {0, -1, 0});
    expect_near(from_unity_euler({330, 0, 0}) * forward, {0, 0.5f, -std::sqrt(0.75f)});
    expect_near(from_unity_euler({0, 0, 90}) * up, {-1, 0, 0});
    // Yaw is about the vertical whatever the pitch is, and roll comes first.
    expect_near(from_unity_euler({45, 90, 0}) * forward, {s, -s, 0});
    expect_near(from_unity_euler({45, 90, 90}) * forward, {s, -s, 0});
    expect_near(from_unity_euler({0, 90, 90}) * up, {0, 0, -1});
}

TEST_F(ViveProEye, ChangesHandedness) {
    const Session session = import("100.5,0.01,0.02,-0.03,0.6,0,0.8,1,2,3,Chair,3,3\n",
                                   "100.5,1,2,3,0,90,0,0,0,0,0,0,0,4,5,6,0,0,90,0.25,True,True\n");
    EXPECT_EQ(session.headset, "vive-pro-eye");
    EXPECT_EQ(session.rate_hz, 90.0);
    ASSERT_EQ(session.head.size(), 1u);
    expect_near(session.head[0].stage_from_head.position, {1, 2, -3});
    ASSERT_EQ(session.gaze.size(), 1u);
    EXPECT_TRUE(session.gaze[0].valid);
    expect_near(session.gaze[0].origin, {0.01f, 0.02f, 0.03f});
    expect_near(session.gaze[0].direction, {0.6f, 0, -0.8f});
    // Looking along +x, 37 degrees to the right of it is towards the wearer's right: +z here.
    expect_near(session.head[0].stage_from_head.orientation * session.gaze[0].direction, {0.8f, 0, 0.6f});

    ASSERT_EQ(session.controllers.size(), 1u);  // the left one was never tracked
    EXPECT_EQ(session.controllers[0].hand, 1);
    const ControllerState& right = session.controllers[0].state;
    EXPECT_TRUE(right.valid);
    expect_near(right.stage_from_grip.position, {4, 5, -6});
    expect_near(right.stage_from_grip.orientation * vec3(0, 1, 0), {-1, 0, 0});
    EXPECT_FLOAT_EQ(right.squeeze, 0.25f);
    EXPECT_FLOAT_EQ(right.trigger, 1.0f);
}

TEST_F(ViveProEye, BothFilesShareOneClockThatStartsAtZero) {
    const Session session = import("10.5,0,0,0,0.6,0,0.8,0,0,0,,3,3\n",
                                   "10.25,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,False,False\n"
                                   "12.25,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,False,False\n");
    EXPECT_EQ(session.head.front().time, 0);
    EXPECT_EQ(session.head.back().time, 2 * nanoseconds_per_second);
    EXPECT_EQ(session.gaze.front().time, nanoseconds_per_second / 4);
    EXPECT_EQ(session.frames, 181u);
    EXPECT_TRUE(session.controllers.empty());
}

TEST_F(ViveProEye, BlinksAreInvalidAndRepeatedRowsNoSamples) {
    const Session session = import(
        "1.00,0.01,0,0,0.6,0,0.8,0,0,0,,3,3\n"
        "1.01,0.01,0,0,0.6,0,0.8,9,9,9,,3,3\n"             // repeated: dropped
        "1.02,0,0,0,0,0,1,-99999,-99999,-99999,,2.8,-1\n"  // no data
        "1.03,0,0,0,0,0,1,-99999,-99999,-99999,,-1,-1\n"   // still none: dropped
        "1.04,0.01,0,0,0.6,0,0.8,0,0,0,,-1,3\n"            // one eye is enough
        "1.05,0.02,0,0,0,0,1,0,0,0,,3,3\n"                 // straight ahead is a gaze
        "1.06,0.02,0,0,0.6,0,0.8,0,0,0,,-1,-1\n"           // no eye seen
        "1.07,0.02,0,0,0,0,0,0,0,0,,3,3\n"                 // still invalid: dropped
        "1.08,0.02,0,0,0.6,0,0.8,0,0,0,,3,3\n",
        "1.00,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,False,False\n");
    std::vector<std::pair<int, bool>> samples;
    for (const GazeSample& g : session.gaze)
        samples.emplace_back(std::lround(to_seconds(g.time) * 100), g.valid);
    const std::vector<std::pair<int, bool>> expected = {{0, true}, {2, false}, {4, true},
                                                        {5, true}, {6, false}, {8, true}};
    EXPECT_EQ(samples, expected);
}

TEST_F(ViveProEye, NamesTheFaultyFileAndLine) {
    const std::string head = "1,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,False,False\n";
    const fs::path gaze = write("g.csv", gaze_header + "1,0,0,0,0,0,1,0,0,0,,3,3\n");
    const fs::path move = write("m.csv", move_header + head);
    EXPECT_NE(message_of({gaze}).find("VR_move log is missing"), std::string::npos);
    EXPECT_NE(message_of({move}).find("Eye_gaze log is missing"), std::string::npos);
    EXPECT_NE(message_of({move, move}).find("second VR_move"), std::string::npos);
    EXPECT_NE(message_of({gaze, folder_ / "none.csv"}).find("none.csv"), std::string::npos);
    EXPECT_NE(message_of({gaze, write("x.csv", "a,b\n1,2\n")}).find("x.csv:1"), std::string::npos);
    EXPECT_NE(message_of({gaze, write("e.csv", move_header)}).find("e.csv"), std::string::npos);
    EXPECT_NE(message_of({gaze, write("t.csv", move_header + head + "0.5" + head.substr(1))}).find("t.csv:3"),
              std::string::npos);
    EXPECT_NE(message_of({gaze, write("n.csv", move_header + "1,nan" + head.substr(3))}).find("n.csv:2"),
              std::string::npos);
}

TEST_F(ViveProEye, CommandWritesASessionThatReadsBack) {
    const fs::path gaze = write("g.csv", gaze_header + "5,0,0,0,0.6,0,0.8,0,0,0,,3,3\n");
    const fs::path move =
        write("m.csv", move_header + "5,1,2,3,0,90,0,0,0,0,0,0,0,0,0,0,0,0,0,0,False,False\n");
    ImportOptions options{
        .files = {gaze, move}, .format = "vive-pro-eye", .out = folder_ / "session", .json = true};
    testing::internal::CaptureStdout();
    EXPECT_EQ(run_import(options), ExitCode::Done);
    EXPECT_NE(testing::internal::GetCapturedStdout().find("\"valid_gaze_samples\": 1"), std::string::npos);
    const Session session = read_session(options.out);
    EXPECT_EQ(session.headset, "vive-pro-eye");
    expect_near(session.head_at(0).position, {1, 2, -3});
    expect_near(session.gaze_at(0).direction, {0.6f, 0, -0.8f});

    options.files = {gaze};
    options.out = folder_ / "other";
    EXPECT_THROW(run_import(options), Fault);
    EXPECT_FALSE(fs::exists(options.out));
}

}  // namespace
}  // namespace foveray::app
