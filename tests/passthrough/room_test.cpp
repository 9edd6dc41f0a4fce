#include "passthrough/room.h"

#include <cmath>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/passthrough/compositor_harness.h"

namespace foveray::passthrough {
namespace {

/// A smooth, colourful paint on everything, as 8-bit sRGB values: a function of the place in stage space.
dvec3 paint(dvec3 p) {
    return {128 + 90 * std::sin(2.1 * p.x + 0.7 * p.z) * std::cos(1.7 * p.y),
            128 + 90 * std::cos(1.3 * p.x - 2.3 * p.y), 128 + 90 * std::sin(1.9 * p.y + 1.1 * p.z + 0.5)};
}

/// The point of the real room that a ray meets.
using Geometry = std::function<dvec3(dvec3 origin, dvec3 direction)>;

dvec3 rotated(const Pose& pose, dvec3 v) { return glm::dquat(pose.orientation) * v; }

/// What a camera there sees of the painted room.
foveray::Image photograph(const Calibration& c, const Pose& stage_from_camera, const Geometry& room) {
    foveray::Image image(c.size.x, c.size.y, 4);
    for (std::uint32_t y = 0; y < c.size.y; ++y) {
        for (std::uint32_t x = 0; x < c.size.x; ++x) {
            const auto direction = unproject(c, {x, y});
            if (!direction) continue;
            const dvec3 color =
                paint(room(dvec3(stage_from_camera.position), rotated(stage_from_camera, *direction)));
            for (int i = 0; i < 3; ++i) image.at(x, y)[i] = static_cast<std::uint8_t>(std::lround(color[i]));
            image.at(x, y)[3] = 255;
        }
    }
    return image;
}

/// Largest difference, in 8-bit steps, between what the view shows and the painted room as its eye would see
/// it, over the pixels whose alpha and environment (black) tell that the camera saw them.
struct Difference {
    double largest = 0;
    int compared = 0;
};
Difference difference(const Composite& result, const View& view, const Geometry& room) {
    Difference d;
    for (std::uint32_t y = 0; y < view.size.y; ++y) {
        for (std::uint32_t x = 0; x < view.size.x; ++x) {
            const glm::u8vec4 shown = result.at(x, y);
            if (shown.r == 0 && shown.g == 0 && shown.b == 0) continue;
            const vec2 uv = (vec2(x, y) + 0.5f) / vec2(view.size);
            const dvec3 direction = rotated(view.stage_from_eye, dvec3(direction_at(view.fov, uv)));
            const dvec3 color = paint(room(dvec3(view.stage_from_eye.position), direction));
            ++d.compared;
            for (int i = 0; i < 3; ++i) d.largest = std::max(d.largest, std::abs(shown[i] - color[i]));
        }
    }
    return d;
}

Pose looking(vec3 position, float yaw, float pitch, float roll) {
    return {glm::angleAxis(yaw, vec3(0, 1, 0)) * glm::angleAxis(pitch, vec3(1, 0, 0)) *
                glm::angleAxis(roll, vec3(0, 0, 1)),
            position};
}

dvec3 wall(dvec3 origin, dvec3 direction) { return origin + direction * ((-2.0 - origin.z) / direction.z); }

/// From inside the box x, z in [-3, 3], y in [0, 2.5].
dvec3 room_box(dvec3 origin, dvec3 direction) {
    const dvec3 low(-3, 0, -3), high(3, 2.5, 3);
    double t = 1e30;
    for (int i = 0; i < 3; ++i) {
        const double d = direction[i];
        if (d != 0) t = std::min(t, ((d > 0 ? high[i] : low[i]) - origin[i]) / d);
    }
    return origin + direction * t;
}

class RoomTest : public CompositorTest {
  protected:
    /// Camera and eye at different places and turned differently.
    CompositorSetup moved(const Geometry& room, vec3 around) {
        CompositorSetup setup;
        Calibration c = default_calibration({400, 320});
        c.head_from_camera = looking({0.03f, 0.01f, -0.06f}, 0.02f, -0.05f, 0.01f);
        setup.calibration = c;
        setup.moment.stage_from_head = looking(around, 0.1f, -0.06f, 0.03f);
        setup.moment.picture =
            camera_frame(photograph(c, setup.moment.stage_from_head * c.head_from_camera, room));
        setup.view = wide_view({120, 96});
        setup.view.stage_from_eye = looking(around + vec3(0.25f, -0.15f, 0.2f), -0.05f, 0.08f, -0.1f);
        return setup;
    }
};

TEST_F(RoomTest, ReprojectsAPlaneToTheFramesPose) {
    CompositorSetup setup = moved(wall, vec3(0, 1.5f, 0));
    setup.surfaces = {{vec3(0, 1, -2), vec3(9, 0, 0), vec3(0, 9, 0), vec3(0)}};
    const Difference with_plane = difference(compose(setup), setup.view, wall);
    EXPECT_GT(with_plane.compared, 7000);
    EXPECT_LT(with_plane.largest, 2.5);
    // The same picture taken to be far away is visibly wrong.
    setup.surfaces.clear();
    EXPECT_GT(difference(compose(setup), setup.view, wall).largest, 25);
}

TEST_F(RoomTest, ReprojectsARoomThatIsABoxAroundTheWearer) {
    CompositorSetup setup = moved(room_box, vec3(0, 1.5f, 0));
    setup.surfaces = {{vec3(0, 1.25f, 0), vec3(0, 0, 3), vec3(3, 0, 0), vec3(0, 1.25f, 0)}};
    const Difference d = difference(compose(setup), setup.view, room_box);
    EXPECT_GT(d.compared, 7000);
    EXPECT_LT(d.largest, 2.5);
}

TEST_F(RoomTest, TheNearestSurfaceCounts) {
    CompositorSetup setup = moved(wall, vec3(0, 1.5f, 0));
    // A box whose front is the wall between planes behind it; and a plane at the wearer's back.
    setup.surfaces = {{vec3(0, 1, -5), vec3(9, 0, 0), vec3(0, 9, 0), vec3(0)},
                      {vec3(0, 1, -3), vec3(0, 9, 0), vec3(0, 0, 1), vec3(9, 0, 0)},
                      {vec3(0, 1, -6), vec3(9, 0, 0), vec3(0, 9, 0), vec3(0)},
                      {vec3(0, 1, 2), vec3(9, 0, 0), vec3(0, 9, 0), vec3(0)}};
    EXPECT_LT(difference(compose(setup), setup.view, wall).largest, 2.5);
}

TEST_F(RoomTest, TakesTheLargestSurfacesWhenThereAreTooMany) {
    CompositorSetup setup = moved(wall, vec3(0, 1.5f, 0));
    setup.surfaces.assign(20, {vec3(0, 1.5f, -1), vec3(0.01f, 0, 0), vec3(0, 0.01f, 0), vec3(0)});
    setup.surfaces.push_back({vec3(0, 1, -2), vec3(9, 0, 0), vec3(0, 9, 0), vec3(0)});
    const Composite result = compose(setup);
    const vec2 uv = (vec2(100, 80) + 0.5f) / vec2(setup.view.size);
    const dvec3 expected =
        paint(wall(dvec3(setup.view.stage_from_eye.position),
                   rotated(setup.view.stage_from_eye, dvec3(direction_at(setup.view.fov, uv)))));
    EXPECT_NEAR(result.at(100, 80).r, expected.r, 2.5);
}

/// Without a lens in between, at the camera's place, everything far away: what remains is the undistortion.
void expect_undistorts_as_opencv(const Calibration& c, const Composite& result, const View& view,
                                 const foveray::Image& distorted) {
    const cv::Mat source(static_cast<int>(distorted.height), static_cast<int>(distorted.width), CV_8UC4,
                         const_cast<std::uint8_t*>(distorted.pixels.data()));
    const cv::Matx33d k(c.focal.x, 0, c.centre.x, 0, c.focal.y, c.centre.y, 0, 0, 1);
    cv::Mat expected;
    if (c.model == LensModel::Fisheye) {
        const cv::Vec4d d(c.distortion[0], c.distortion[1], c.distortion[2], c.distortion[3]);
        cv::fisheye::undistortImage(source, expected, k, d, k);
    } else {
        cv::undistort(source, expected, k, std::vector<double>(c.distortion.begin(), c.distortion.end()));
    }
    int compared = 0;
    for (int y = 0; y < expected.rows; ++y) {
        for (int x = 0; x < expected.cols; ++x) {
            const auto pixel = expected.at<cv::Vec4b>(y, x);
            const glm::u8vec4 shown = result.at(x, y);
            if (pixel[3] != 255 || (shown.r | shown.g | shown.b) == 0) continue;  // outside the picture
            ++compared;
            for (int i = 0; i < 3; ++i) ASSERT_NEAR(shown[i], pixel[i], 3) << x << ' ' << y << ' ' << i;
        }
    }
    EXPECT_GT(compared, static_cast<int>(view.size.x * view.size.y * 6 / 10));
}

class Undistortion : public CompositorTest, public testing::WithParamInterface<Calibration> {};

TEST_P(Undistortion, AgreesWithOpenCv) {
    const Calibration& c = GetParam();
    foveray::Image distorted(c.size.x, c.size.y, 4);
    for (std::uint32_t y = 0; y < c.size.y; ++y) {
        for (std::uint32_t x = 0; x < c.size.x; ++x) {
            const dvec3 color = paint({x * 0.02, y * 0.02, 0.3});
            for (int i = 0; i < 3; ++i)
                distorted.at(x, y)[i] = static_cast<std::uint8_t>(std::lround(color[i]));
            distorted.at(x, y)[3] = 255;
        }
    }
    CompositorSetup setup;
    setup.calibration = c;
    setup.moment.picture = camera_frame(distorted);
    setup.view.size = c.size;
    // The view whose pixels are those of a camera with this focal length and centre and no distortion.
    const vec2 focal(c.focal), centre(c.centre + 0.5), end(c.size);
    setup.view.fov = {-std::atan(centre.x / focal.x), std::atan((end.x - centre.x) / focal.x),
                      std::atan(centre.y / focal.y), -std::atan((end.y - centre.y) / focal.y)};
    expect_undistorts_as_opencv(c, compose(setup), setup.view, distorted);
}

Calibration lens(LensModel model, dvec2 focal, std::array<double, 8> distortion) {
    Calibration c;
    c.model = model;
    c.size = {240, 180};
    c.focal = focal;
    c.centre = {124.5, 86.0};
    c.distortion = distortion;
    return c;
}

INSTANTIATE_TEST_SUITE_P(
    Models, Undistortion,
    testing::Values(lens(LensModel::Pinhole, {150, 148}, {-0.24, 0.06, 0.004, -0.003, -0.005}),
                    lens(LensModel::Pinhole, {170, 171}, {0.2, -0.1, -0.003, 0.002, 0.01, 0.25, -0.08, 0.01}),
                    lens(LensModel::Fisheye, {110, 112}, {-0.02, 0.03, -0.015, 0.004})));

TEST_F(RoomTest, ANewPictureReplacesTheOneBefore) {
    gpu::TextureTable textures(device());
    const uvec2 size(8, 8);
    RoomStage room_stage(device(), textures, 2, default_calibration(size), {}, 10.0f);
    const Compositor compositor(device(), textures);
    const std::vector<shared::ResolvedPixel> nothing(64, {{0, 0}});
    gpu::Buffer resolved(device(), "resolved", 64 * sizeof(shared::ResolvedPixel), gpu::Residence::Upload);
    resolved.write(gpu::range_bytes(nothing));
    const View view = wide_view(size);
    const CameraFramePtr red = camera_frame(plain_picture(size, {250, 0, 0}), 0);
    const CameraFramePtr green = camera_frame(plain_picture(size, {0, 250, 0}), 1);
    const std::vector<CameraFramePtr> shown{nullptr, red, red, green, green, red};

    std::vector<gpu::Buffer> colors;
    gpu::Buffer depth(device(), "depth", 64 * 4, gpu::Residence::Device);
    {
        gpu::FrameRing ring(device(), 2);
        for (std::size_t i = 0; i < shown.size(); ++i) {
            colors.emplace_back(device(), "color " + std::to_string(i), 64 * 4, gpu::Residence::Readback);
            const shared::ViewImage image{resolved.address(), 0, colors.back().address(), depth.address(),
                                          size};
            const gpu::Commands cmd = ring.begin();
            const Room room = room_stage.record(cmd, ring.slot(), {shown[i], {}, {}}, Settings{});
            EXPECT_EQ(room.has_picture, shown[i] != nullptr);
            cmd.barrier(gpu::Access::ComputeWrite, gpu::Access::ComputeWrite);  // depth is written again
            compositor.record(cmd, view, image, room, 0, Background::Camera,
                              Settings{});
            cmd.barrier(gpu::Access::ComputeWrite, gpu::Access::HostRead);
            ring.submit();
        }
        ring.wait();
    }
    for (std::size_t i = 0; i < shown.size(); ++i) {
        colors[i].invalidate();
        const glm::u8vec4 pixel = colors[i].mapped_as<glm::u8vec4>()[27];
        EXPECT_EQ(pixel.r, shown[i] == red ? 250 : 0) << i;
        EXPECT_EQ(pixel.g, shown[i] == green ? 250 : 0) << i;
    }
}

}  // namespace
}  // namespace foveray::passthrough
