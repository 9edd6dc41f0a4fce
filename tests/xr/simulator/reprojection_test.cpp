// Layers meet the head where it is at the display time: projections are turned, other layers are located
// then.
#include <cmath>

#include "tests/xr/simulator/composed.h"

namespace foveray::simulator_tests {
namespace {

class Reprojection : public Composed {
  protected:
    /// The head stands at frame 0 and is at `next` from frame 1 on.
    void play(const Pose& next, std::vector<Session::Event> events = {},
              XrViewConfigurationType type = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) {
        Session script = make_session(10);
        script.head = {{0, {quat(1, 0, 0, 0), vec3(0, 1.6f, 0)}}, {from_seconds(1.0 / 30), next}};
        script.events = std::move(events);
        write_session(folder_.path() / "s", script);
        start({{"SESSION", folder_.path() / "s"}}, type);
        stage_ = client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE);
    }
    static Pose turned(float degrees, vec3 axis) {
        return {glm::angleAxis(radians(degrees), axis), vec3(0, 1.6f, 0)};
    }

    /// Grey with a white cross, four pixels wide, whose upper left edges meet in the middle of 256 x 256
    /// pixels.
    XrSwapchain make_cross() {
        return make_picture({256, 256}, {{{{0, 0}, {256, 256}}, {60, 60, 60, 255}},
                                         {{{128, 0}, {4, 256}}, {255, 255, 255, 255}},
                                         {{{0, 128}, {256, 4}}, {255, 255, 255, 255}}});
    }
    /// As frame 0 is rendered.
    std::vector<XrCompositionLayerProjectionView> make_views(XrSwapchain swapchain, XrTime time) {
        std::vector<XrCompositionLayerProjectionView> views;
        for (const XrView& view : client_->locate_views(stage_, time, type_, false)) {
            views.push_back({XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                             nullptr,
                             view.pose,
                             view.fov,
                             {swapchain, {{0, 0}, {256, 256}}, 0}});
        }
        return views;
    }
    XrCompositionLayerProjection projection(
        const std::vector<XrCompositionLayerProjectionView>& views) const {
        return {XR_TYPE_COMPOSITION_LAYER_PROJECTION,     nullptr,     0, stage_,
                static_cast<std::uint32_t>(views.size()), views.data()};
    }
    /// Middle of the white pixels of a row, or of a column.
    static float white_middle(const Image& image, std::uint32_t line, bool is_row) {
        float sum = 0.0f, weight = 0.0f;
        for (std::uint32_t i = 0; i < 256; ++i) {
            const int value = is_row ? pixel(image, i, line)[0] : pixel(image, line, i)[0];
            const float w = std::max(0.0f, linear_of(value) - linear_of(60));
            sum += w * (static_cast<float>(i) + 0.5f);
            weight += w;
        }
        return sum / weight;
    }
    XrTime frame_time() { return client_->empty_frame().predictedDisplayTime; }

    XrSpace stage_ = XR_NULL_HANDLE;
};

TEST_F(Reprojection, AProjectionOfTheRightPoseStaysAsItIs) {
    play(turned(10.0f, {0, 1, 0}));
    const XrTime first = frame_time();
    ++frames_;
    const auto views = make_views(make_cross(), first + from_seconds(1.0 / 30));
    show_opaque(projection(views));
    const Image image = shown(0);
    EXPECT_EQ(pixel(image, 127, 20), (Rgb{60, 60, 60}));
    EXPECT_EQ(pixel(image, 128, 20), (Rgb{255, 255, 255}));
    EXPECT_EQ(pixel(image, 131, 20), (Rgb{255, 255, 255}));
    EXPECT_EQ(pixel(image, 132, 20), (Rgb{60, 60, 60}));
    EXPECT_EQ(pixel(image, 0, 0), (Rgb{60, 60, 60}));
}

TEST_F(Reprojection, AnOldPoseIsTurnedToTheHeads) {
    play(turned(10.0f, {0, 1, 0}));  // to the left
    const XrTime first = frame_time();
    ++frames_;
    const auto views = make_views(make_cross(), first);
    show_opaque(projection(views));
    const float ten = radians(10.0f), middle = std::atan(2.0f / 128);
    for (int eye = 0; eye < 2; ++eye) {
        EXPECT_NEAR(white_middle(shown(eye), 60, true), 128 + 128 * std::tan(ten + middle), 0.3);
        // Behind the turned picture's left edge there is nothing.
        const auto edge = static_cast<std::uint32_t>(128 - 128 * std::tan(radians(35.0f)));
        EXPECT_EQ(pixel(shown(eye), edge - 3, 60), (Rgb{0, 0, 0}));
        EXPECT_EQ(pixel(shown(eye), edge + 3, 60), (Rgb{60, 60, 60}));
    }
}

TEST_F(Reprojection, UpAndDownToo) {
    play(turned(-6.0f, {1, 0, 0}));  // down
    const XrTime first = frame_time();
    ++frames_;
    const auto views = make_views(make_cross(), first);
    show_opaque(projection(views));
    EXPECT_NEAR(white_middle(shown(0), 60, false),
                128 - 128 * std::tan(radians(6.0f) - std::atan(2.0f / 128)), 0.3);
}

TEST_F(Reprojection, ContextAndFocusAreTurnedAlike) {
    play(turned(5.0f, {0, 1, 0}), {}, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO);
    const XrTime first = frame_time();
    ++frames_;
    auto views = make_views(make_plain({100, 0, 0, 255}), first);
    for (std::size_t i = 0; i < 4; ++i) {
        views[i].subImage.imageRect.extent = {64, 64};
        if (i >= 2) views[i].subImage.swapchain = make_plain({0, 100, 0, 255});
    }
    show_opaque(projection(views));
    // Three times as many greens would be between the focus's edges, 20 degrees off, less the border, without
    // the turn.
    const Image image = shown(0);
    const auto column = [&](float degrees) {
        return static_cast<std::uint32_t>((0.5f + 0.5f * std::tan(radians(degrees))) *
                                          static_cast<float>(image.width));
    };
    const std::uint32_t row = image.height / 2;
    EXPECT_EQ(pixel(image, column(26.0f), row), (Rgb{100, 0, 0}));
    EXPECT_EQ(pixel(image, column(20.0f), row), (Rgb{0, 100, 0}));
    EXPECT_EQ(pixel(image, column(-10.0f), row), (Rgb{0, 100, 0}));
    EXPECT_EQ(pixel(image, column(-16.0f), row), (Rgb{100, 0, 0}));
}

TEST_F(Reprojection, FlippedFieldsOfViewMirror) {
    play(turned(0.0f, {0, 1, 0}));
    const XrTime first = frame_time();
    ++frames_;
    auto views = make_views(make_cross(), first);
    std::swap(views[0].fov.angleLeft, views[0].fov.angleRight);
    std::swap(views[1].fov.angleUp, views[1].fov.angleDown);
    show_opaque(projection(views));
    EXPECT_NEAR(white_middle(shown(0), 60, true), 126, 0.1);
    EXPECT_NEAR(white_middle(shown(0), 60, false), 130, 0.1);
    EXPECT_NEAR(white_middle(shown(1), 60, true), 130, 0.1);
    EXPECT_NEAR(white_middle(shown(1), 60, false), 126, 0.1);
}

TEST_F(Reprojection, SurfacesStayWhereTheirSpacesAre) {
    play({glm::angleAxis(radians(90.0f), vec3(0, 1, 0)), vec3(1, 1.6f, 0)});
    auto on_head = make_quad(make_plain({250, 0, 0, 255}));
    on_head.space = client_->reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    auto on_stage = make_quad(make_plain({0, 250, 0, 255}));
    on_stage.space = stage_;
    on_stage.pose.position = {0, 1.6f, -3};
    show_opaque(on_head, on_stage);
    EXPECT_EQ(pixel(shown(0), 128, 128), (Rgb{0, 250, 0}));
    show_opaque(on_head, on_stage);
    EXPECT_EQ(pixel(shown(0), 128, 128), (Rgb{250, 0, 0})) << "the head looks elsewhere";
    // Three metres before the turned head, facing it.
    on_stage.pose = {{0, std::sin(radians(45.0f)), 0, std::cos(radians(45.0f))}, {-2, 1.6f, 0}};
    show_opaque(on_head, on_stage);
    EXPECT_EQ(pixel(shown(0), 128, 128), (Rgb{0, 250, 0}));
}

TEST_F(Reprojection, WithoutTrackingProjectionsAreShownAsSubmitted) {
    play(turned(10.0f, {0, 1, 0}), {{from_seconds(1.0 / 30), "head_tracking_lost", ""}});
    const XrTime first = frame_time();
    ++frames_;
    const auto views = make_views(make_cross(), first);
    auto on_head = make_quad(make_plain({250, 0, 0, 255}), 0.5f);
    on_head.space = client_->reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    auto on_stage = make_quad(make_plain({0, 250, 0, 255}), 50.0f, 1.0f);
    on_stage.space = stage_;
    show_opaque(projection(views), on_stage, on_head);
    EXPECT_NEAR(white_middle(shown(0), 60, true), 130, 0.1);
    EXPECT_EQ(pixel(shown(0), 128, 128), (Rgb{250, 0, 0}));
}

}  // namespace
}  // namespace foveray::simulator_tests
