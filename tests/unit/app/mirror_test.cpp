#include <cmath>

#include <gtest/gtest.h>
#include <imgui.h>

#include "app/mirror/panel.h"
#include "app/mirror/picture_layout.h"

namespace foveray::app {
namespace {

void expect_rect(const Rect& rect, vec2 min, vec2 max) {
    EXPECT_NEAR(rect.min.x, min.x, 1e-4f);
    EXPECT_NEAR(rect.min.y, min.y, 1e-4f);
    EXPECT_NEAR(rect.max.x, max.x, 1e-4f);
    EXPECT_NEAR(rect.max.y, max.y, 1e-4f);
}

TEST(PictureLayout, FitsIntoTheMiddle) {
    expect_rect(fit({{0, 0}, {200, 100}}, 1.0f), {50, 0}, {150, 100});
    expect_rect(fit({{10, 20}, {110, 220}}, 2.0f), {10, 95}, {110, 145});
}

TEST(PictureLayout, FocusLiesWhereItsFieldOfViewIs) {
    const float t = std::atan(0.5f);
    const Fov context{-radians(45), radians(45), radians(45), -radians(45)};
    EXPECT_NEAR(aspect_of(context), 1.0f, 1e-5f);
    expect_rect(place_within({-t, t, t, -t}, context), {0.25f, 0.25f}, {0.75f, 0.75f});
    // Looking to the right and up: the picture's right half, above the middle.
    expect_rect(place_within({0, radians(45), t, 0}, context), {0.5f, 0.25f}, {1, 0.5f});
    expect_rect(part_of({{100, 0}, {300, 100}}, {{0.25f, 0.5f}, {0.5f, 1}}), {150, 50}, {200, 100});
}

TEST(TimeHistory, KeepsTheNewestInOrder) {
    TimeHistory history;
    EXPECT_EQ(history.size(), 0u);
    for (std::size_t i = 0; i < TimeHistory::length + 5; ++i) {
        FrameMetrics metrics;
        metrics.cpu_ms = static_cast<double>(i);
        metrics.stages = {{"a", 1.0}, {"b", static_cast<double>(i)}};
        history.add(metrics);
        EXPECT_EQ(history.cpu_ms(history.size() - 1), static_cast<float>(i));
    }
    EXPECT_EQ(history.size(), TimeHistory::length);
    EXPECT_EQ(history.cpu_ms(0), 5.0f);
    EXPECT_EQ(history.gpu_ms(0), 6.0f);
}

/// The panel without a window: Dear ImGui only collects what it would draw.
class Panel : public testing::Test {
  protected:
    void SetUp() override {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {800, 2000};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    void TearDown() override { ImGui::DestroyContext(); }

    /// One frame with the mouse at a place.
    void frame(vec2 mouse, bool pressed) {
        ImGuiIO& io = ImGui::GetIO();
        io.DeltaTime = 1.0f / 60;
        io.MousePos = {mouse.x, mouse.y};
        io.MouseDown[0] = pressed;
        ImGui::NewFrame();
        draw_panel(state_, settings_, history_, metrics_, GazeSource::Mouse);
        ImGui::Render();
    }

    MirrorState state_;
    Settings settings_;
    TimeHistory history_;
    FrameMetrics metrics_;
};

TEST_F(Panel, DrawingChangesNoSetting) {
    settings_.shadow_samples = 17;
    settings_.debug_view = "tiles";
    const Settings before = settings_;
    for (int i = 0; i < 3; ++i) frame({0, 0}, false);
    EXPECT_GT(ImGui::GetDrawData()->TotalVtxCount, 1000);
    for (const SettingInfo& info : settings_table()) {
        EXPECT_EQ(value_text(settings_, info), value_text(before, info)) << info.key;
    }
}

TEST_F(Panel, ClicksReachSettings) {
    for (int i = 0; i < 2; ++i) frame({0, 0}, false);
    // Click down the panel's left column, where the check boxes are; from below, because groups close when
    // clicked.
    int changes = 0;
    for (float y = 1900; y > 60; y -= 6) {
        const Settings before = settings_;
        const vec2 place(800 - panel_width + 22, y);
        frame(place, false);
        frame(place, true);
        frame(place, false);
        changes += before.shadows != settings_.shadows;
    }
    EXPECT_GT(changes, 0);
}

}  // namespace
}  // namespace foveray::app
