// The program with users' shapes: exit codes, and a file that is edited while it is shown.
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "tests/demo/running_view.h"

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

TEST_F(UserShapeProgram, ReloadsASavedFileAndKeepsTheLastGoodOne) {
    const auto expect_color = [](const fakes::RunningView& view, int channel) {
        const vec3 color = view.color_now();
        for (int i = 0; i < 3; ++i) EXPECT_EQ(color[i] > 0.5f, i == channel) << i << " " << color[i];
    };
    write_shape(ball("1.0, 0.0, 0.0"));
    fakes::RunningView view(folder_, {}, fakes::RunningView::Pictures::Kept);
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
