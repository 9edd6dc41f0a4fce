// A scene that is edited while it is shown.
#include <gtest/gtest.h>

#include "base/image.h"
#include "base/json.h"
#include "base/session.h"
#include "tests/demo/running_view.h"

namespace foveray {
namespace {

namespace fs = std::filesystem;

class LiveEditTest : public testing::Test {
  protected:
    void save(const std::string& name, const std::string& text) {
        // As editors do it: a new file takes the old one's name.
        fs::rename(folder_.write(name + ".new", text), folder_ / name);
    }
    static Json ball(const Json& color) {
        return {{"shape", "sphere"},
                {"material", {{"base_color", color}, {"unlit", true}}},
                {"transform", {{"translation", {0, 1.6, -1.5}}}}};
    }
    void save_scene(const Json& objects, const Json& more = Json::object()) {
        Json json = {{"format", "foveray-scene"}, {"version", 1}, {"objects", objects}};
        json.update(more);
        save("scene.json", json.dump());
    }

    fakes::TemporaryFolder folder_;
};

TEST_F(LiveEditTest, SavedScenesAreShownBrokenOnesLeaveTheLastAndRecordingsTell) {
    const Json probes = {{"probes", {{"counts", {3, 2, 3}}, {"center", {0, 1, -1}}, {"size", {3, 2, 3}}}}};
    save_scene(Json::array({ball({1, 0, 0})}));
    fakes::RunningView view(folder_, {"--record", (folder_ / "recording").string()});
    view.wait_for("Ctrl-C ends");
    // Another kind of shape, lights, a real surface, probes.
    const Json box = {{"shape", "box"}, {"transform", {{"translation", {0.5, 1, -2}}}}};
    Json more = probes;
    more["lights"] = {
        {{"type", "area"}, {"center", {0, 3, 0}}, {"half_u", {1, 0, 0}}, {"half_v", {0, 0, -1}}}};
    more["real_surfaces"] = {
        {{"type", "plane"}, {"center", {0, 0, 0}}, {"normal", {0, 1, 0}}, {"half_size", {2, 2}}}};
    save_scene({ball({0, 1, 0}), box}, more);
    view.wait_for("scene.json: reloaded");
    save_scene(Json::array({{{"shape", "sphere"}, {"parameters", {{"radius", -1}}}}}));
    view.wait_for("scene.json: /objects/0/parameters/radius: ");
    view.wait_for("the last good scene stays");
    // A file that is missing, then put where it belongs.
    more["environment"] = {{"file", "sky.hdr"}};
    save_scene(Json::array({ball({0, 0, 1})}), more);
    view.wait_for("sky.hdr");
    save("sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x81\x40\x40\x80\x81");
    view.wait_for("sky.hdr: reloaded");
    EXPECT_EQ(view.end(), 0) << view.log();
    EXPECT_EQ(view.log().find("Validation"), std::string::npos) << view.log();

    const Session recorded = read_session(folder_ / "recording");
    ASSERT_GE(recorded.events.size(), 2u);
    EXPECT_EQ(recorded.events[0].name, scene_changed_event);
    EXPECT_GT(recorded.events[0].time, 0);
    const auto replayed =
        fakes::run_foveray({"replay", (folder_ / "recording").string(), "--frames", "0:1", "--out",
                            (folder_ / "out").string(), "--set", "camera.blend=off"});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    EXPECT_NE(replayed.err.find("the scene was edited 2 times"), std::string::npos) << replayed.err;
    // It shows the scene as it is now, whose ball is blue.
    const Image shown = read_image((folder_ / "out/frames/frame_00000_left.png").string(), 3);
    const std::uint8_t* middle =
        &shown.pixels[3 * (std::size_t{shown.height / 2} * shown.width + shown.width / 2)];
    EXPECT_GT(middle[2], 200);
    EXPECT_LT(middle[0], 50);
}

}  // namespace
}  // namespace foveray
