// The program with users' shapes: exit codes, and a file that is edited while it is shown.
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/demo/run_program.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray {
namespace {

namespace fs = std::filesystem;

class UserShapeProgram : public testing::Test {
  protected:
    void SetUp() override {
        folder_.write(
            "session/session.json",
            R"({"format":"foveray-session","version":1,"headset":"ci","rate_hz":10,"frames":1,"recorded":[]})");
        folder_.write("scene.json",
                      R"({"format":"foveray-scene","version":1,"objects":[{"shape":"user","file":"shape.glsl",
"bounds":{"min":[-0.5,-0.5,-0.5],"max":[0.5,0.5,0.5]},"material":{"unlit":true},"transform":{"translation":[0,1.6,-1.2]}}]})");
    }
    void write_shape(const std::string& text) {
        // As editors do it: a new file takes the old one's name.
        const fs::path made = folder_.write("shape.glsl.new", text);
        fs::rename(made, folder_ / "shape.glsl");
    }
    static std::string ball(const std::string& color) {
        return "float distance_at(vec3 p) { return length(p) - 0.4; }\nvec4 color_at(vec3 p, vec3 n) { "
               "return vec4(" +
               color + ", 1.0); }\n";
    }
    fakes::ProgramResult replay() {
        return fakes::run_foveray({"replay", (folder_ / "session").string(), "--scene",
                                   (folder_ / "scene.json").string(), "--out", (folder_ / "out").string()});
    }
    void refuse(const std::string& text, const std::string& part) {
        write_shape(text);
        const auto result = replay();
        EXPECT_EQ(result.exit_code, 2) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(result.err.find("Validation"), std::string::npos) << result.err;
        EXPECT_FALSE(fs::exists(folder_ / "out"));
    }

    fakes::TemporaryFolder folder_;
};

TEST_F(UserShapeProgram, ReplaysAGoodShape) {
    write_shape(ball("1.0, 0.0, 0.0"));
    const auto result = replay();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err.find("Validation"), std::string::npos) << result.err;
}

TEST_F(UserShapeProgram, RefusesBadShapes) {
    refuse("float distance_at(vec3 p) {\n  return p.q;\n}", "shape.glsl:2: ");
    refuse("float distance_at(vec3 p) { return length(p) - 0.7; }",
           "shape.glsl:1: distance_at reaches out of its bounds");
    refuse("float distance_at(vec3 p) { return sqrt(p.x) - 0.1; }", "shape.glsl:1: distance_at returns NaN");
    refuse(
        "float distance_at(vec3 p) {\n float x = 0.5;\n for (;;) {\n  x = fract(x * 1.37 + p.x);\n"
        "  if (x > 2.0) break;\n }\n return x; }",
        "shape.glsl:1: distance_at does not finish a small picture within 2 s");
    refuse("float distance_at(vec3 p, float x) { return x; }",
           "/objects/0/parameters: shape.glsl takes \"x\"");
    fs::remove(folder_ / "shape.glsl");
    const auto result = replay();
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("shape.glsl: cannot be read"), std::string::npos) << result.err;
}

/// `foveray view` on the simulated headset, until it is told to end.
class View {
  public:
    explicit View(const fakes::TemporaryFolder& folder) : folder_(folder) {
        ::setenv("FOVERAY_VALIDATION", "1", 1);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder / "log").c_str(),
                                         O_CREAT | O_WRONLY, 0600);
        std::vector<std::string> words = {
            FOVERAY_PROGRAM, "view", (folder / "scene.json").string(), "--runtime", "simulator",
            "--headset",     "ci"};
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        EXPECT_EQ(posix_spawn(&pid_, FOVERAY_PROGRAM, &actions, nullptr, argv.data(), environ), 0);
        posix_spawn_file_actions_destroy(&actions);
    }
    ~View() {
        if (pid_ > 0) ::kill(pid_, SIGKILL);
    }

    std::string log() const { return fakes::file_bytes(folder_ / "log"); }
    void wait_for(const std::string& part) const {
        for (int i = 0; i < 2400 && log().find(part) == std::string::npos; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        EXPECT_NE(log().find(part), std::string::npos) << log();
    }
    int end() {
        ::kill(pid_, SIGINT);
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    const fakes::TemporaryFolder& folder_;
    pid_t pid_ = 0;
};

TEST_F(UserShapeProgram, ReloadsASavedFileAndKeepsTheLastGoodOne) {
    write_shape(ball("1.0, 0.0, 0.0"));
    View view(folder_);
    view.wait_for("Ctrl-C ends");
    write_shape(ball("0.0, 1.0, 0.0"));
    view.wait_for("shape.glsl: reloaded");
    write_shape("float distance_at(vec3 p) {\n  return p.q;\n}");
    view.wait_for("shape.glsl:2: ");
    view.wait_for("the last good shape stays");
    EXPECT_EQ(view.end(), 0) << view.log();
    EXPECT_EQ(view.log().find("Validation"), std::string::npos) << view.log();
}

}  // namespace
}  // namespace foveray
