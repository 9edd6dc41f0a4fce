// The program with users' shapes: exit codes, and a file that is edited while it is shown.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "base/image.h"
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

/// `foveray view` until it is told to end, on a simulated headset that keeps what it shows. As the system's
/// runtime: what `--runtime simulator` shows is not kept.
class View {
  public:
    explicit View(const fakes::TemporaryFolder& folder) : folder_(folder) {
        ::setenv("FOVERAY_VALIDATION", "1", 1);
        ::setenv("XR_RUNTIME_JSON", FOVERAY_SIMULATOR_JSON, 1);
        ::setenv("FOVERAY_SIMULATOR_PROFILE", "ci", 1);
        fs::create_directory(captures());
        ::setenv("FOVERAY_SIMULATOR_CAPTURE", captures().c_str(), 1);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder / "log").c_str(),
                                         O_CREAT | O_WRONLY, 0600);
        std::vector<std::string> words = {FOVERAY_PROGRAM, "view", (folder / "scene.json").string(),
                                          "--runtime", "system"};
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        EXPECT_EQ(posix_spawn(&pid_, FOVERAY_PROGRAM, &actions, nullptr, argv.data(), environ), 0);
        posix_spawn_file_actions_destroy(&actions);
        for (const char* name : {"XR_RUNTIME_JSON", "FOVERAY_SIMULATOR_PROFILE", "FOVERAY_SIMULATOR_CAPTURE"})
            ::unsetenv(name);
    }
    ~View() {
        if (pid_ > 0) ::kill(pid_, SIGKILL);
    }

    std::string log() const { return fakes::file_bytes(folder_ / "log"); }
    void wait_for(const std::string& part) const {
        EXPECT_TRUE(until([&] { return log().find(part) != std::string::npos; })) << part << "\n" << log();
    }
    /// The middle of the left eye's picture, of a frame that began after now.
    vec3 color_now() const {
        const std::size_t before = frames().size();
        const bool shown = until([&] { return frames().size() > before + 3; });
        EXPECT_TRUE(shown) << log();
        if (!shown) return vec3(-1.0f);
        const Image image = read_image(frames()[before + 2], 3);
        const std::uint8_t* middle = image.at(image.width / 2, image.height / 2);
        return vec3(middle[0], middle[1], middle[2]) / 255.0f;
    }
    int end() {
        ::kill(pid_, SIGINT);
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    fs::path captures() const { return folder_ / "captures"; }
    /// What the left eye saw, in the order of time; the last may still be written.
    std::vector<fs::path> frames() const {
        std::vector<fs::path> result;
        for (const auto& entry : fs::directory_iterator(captures())) {
            if (entry.path().filename().string().ends_with("_left.png")) result.push_back(entry.path());
        }
        std::ranges::sort(result);
        return result;
    }
    template <typename Condition>
    static bool until(const Condition& condition) {
        for (int i = 0; i < 2400; ++i) {
            if (condition()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        return false;
    }

    const fakes::TemporaryFolder& folder_;
    pid_t pid_ = 0;
};

TEST_F(UserShapeProgram, ReloadsASavedFileAndKeepsTheLastGoodOne) {
    const auto expect_color = [](const View& view, int channel) {
        const vec3 color = view.color_now();
        for (int i = 0; i < 3; ++i) EXPECT_EQ(color[i] > 0.5f, i == channel) << i << " " << color[i];
    };
    write_shape(ball("1.0, 0.0, 0.0"));
    View view(folder_);
    view.wait_for("Ctrl-C ends");
    expect_color(view, 0);
    write_shape(ball("0.0, 1.0, 0.0"));
    view.wait_for("shape.glsl: reloaded");
    expect_color(view, 1);
    // Each would be seen if it were shown: nearer, and blue.
    const std::string blue = "vec4 color_at(vec3 p, vec3 n) { return vec4(0.0, 0.0, 1.0, 1.0); }\n";
    const std::pair<std::string, std::string> bad[] = {
        {"float distance_at(vec3 p) {\n  return p.q;\n}", "shape.glsl:2: "},
        {"float distance_at(vec3 p) {\n float x = 0.5;\n for (;;) {\n  x = fract(x * 1.37 + p.x);\n"
         "  if (x > 2.0) break;\n }\n return x; }",
         "does not finish a small picture within 2 s"},
        {"float distance_at(vec3 p) { return p.x > 0.3 ? sqrt(-p.x) : length(p) - 0.45; }", "returns NaN"},
        {"float distance_at(vec3 p) { return length(p) - 0.7; }", "reaches out of its bounds"},
    };
    for (const auto& [text, reason] : bad) {
        SCOPED_TRACE(reason);
        write_shape(text + "\n" + blue);
        view.wait_for(reason);
        view.wait_for("the last good shape stays");
        expect_color(view, 1);
    }
    write_shape(ball("0.0, 0.0, 1.0"));
    const auto is_blue = [&] { return view.color_now().b > 0.5f; };
    for (int i = 0; i < 100 && !is_blue(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    expect_color(view, 2);
    EXPECT_EQ(view.end(), 0) << view.log();
    EXPECT_EQ(view.log().find("Validation"), std::string::npos) << view.log();
}

}  // namespace
}  // namespace foveray
