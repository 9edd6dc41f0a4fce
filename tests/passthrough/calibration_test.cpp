#include "passthrough/calibration.h"

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "base/error.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray::passthrough {
namespace {

Calibration pinhole(std::array<double, 8> distortion) {
    Calibration c;
    c.size = {1280, 720};
    c.focal = {812.5, 806.25};
    c.centre = {655.0, 341.5};
    c.distortion = distortion;
    return c;
}

Calibration fisheye(std::array<double, 8> distortion) {
    Calibration c = pinhole(distortion);
    c.model = LensModel::Fisheye;
    c.focal = {410.0, 412.0};
    return c;
}

/// OpenCV's camera looks along +z with y down.
dvec2 project_by_opencv(const Calibration& c, dvec3 p) {
    const std::vector<cv::Point3d> points{{p.x, -p.y, -p.z}};
    const cv::Matx33d k(c.focal.x, 0, c.centre.x, 0, c.focal.y, c.centre.y, 0, 0, 1);
    std::vector<cv::Point2d> pixels;
    const cv::Vec3d zero(0, 0, 0);
    if (c.model == LensModel::Fisheye) {
        const cv::Vec4d d(c.distortion[0], c.distortion[1], c.distortion[2], c.distortion[3]);
        cv::fisheye::projectPoints(points, pixels, zero, zero, k, d);
    } else {
        cv::projectPoints(points, zero, zero, k,
                          std::vector<double>(c.distortion.begin(), c.distortion.end()), pixels);
    }
    return {pixels[0].x, pixels[0].y};
}

class Lens : public testing::TestWithParam<Calibration> {};

TEST_P(Lens, ProjectsAsOpenCvDoes) {
    const Calibration& c = GetParam();
    int seen = 0;
    for (double x = -0.9; x <= 0.9; x += 0.09) {
        for (double y = -0.6; y <= 0.6; y += 0.1) {
            const dvec3 point = dvec3(x, y, -1.0) * 2.5;
            const auto pixel = project(c, point);
            if (!pixel) continue;
            ++seen;
            const dvec2 expected = project_by_opencv(c, point);
            EXPECT_NEAR(pixel->x, expected.x, 1e-6) << x << ' ' << y;
            EXPECT_NEAR(pixel->y, expected.y, 1e-6) << x << ' ' << y;
        }
    }
    EXPECT_GT(seen, 150);
}

TEST_P(Lens, UnprojectsEveryPixelToTheDirectionThatProjectsThere) {
    const Calibration& c = GetParam();
    for (double x = 0; x < c.size.x; x += 61) {
        for (double y = 0; y < c.size.y; y += 47) {
            const auto direction = unproject(c, {x, y});
            ASSERT_TRUE(direction) << x << ' ' << y;
            EXPECT_NEAR(glm::length(*direction), 1.0, 1e-9);
            const auto pixel = project(c, *direction * 3.0);
            ASSERT_TRUE(pixel) << x << ' ' << y;
            EXPECT_NEAR(pixel->x, x, 1e-6);
            EXPECT_NEAR(pixel->y, y, 1e-6);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, Lens,
                         testing::Values(pinhole({}), pinhole({-0.21, 0.04, 0.0011, -0.0007, 0.0}),
                                         pinhole({0.12, -0.05, -0.002, 0.001, 0.01}),
                                         pinhole({0.3, -0.1, 0.0004, -0.0003, 0.02, 0.45, -0.12, 0.015}),
                                         fisheye({}), fisheye({-0.013, 0.021, -0.014, 0.0033})));

TEST(Calibration, CentreLooksForwardAndAxesAreRightAndUp) {
    const Calibration c = default_calibration({640, 480});
    const auto centre = project(c, {0, 0, -1});
    ASSERT_TRUE(centre);
    EXPECT_DOUBLE_EQ(centre->x, 319.5);
    EXPECT_DOUBLE_EQ(centre->y, 239.5);
    EXPECT_GT(project(c, {0.1, 0, -1})->x, centre->x);
    EXPECT_LT(project(c, {0, 0.1, -1})->y, centre->y);
    // 90 degrees: the outer edge of the last pixel, half a pixel past its centre, is at tangent 1.
    EXPECT_NEAR(project(c, {1, 0, -1})->x, 639.5, 1e-9);
}

TEST(Calibration, SeesNothingBehindAPinholeAndPastTheModelsRange) {
    EXPECT_FALSE(project(pinhole({}), {0.1, 0, 1}));
    EXPECT_FALSE(project(pinhole({}), {3, 0, -1}));
    // Strong barrel distortion folds back: r (1 - 0.4 r^2) grows until r = sqrt(1 / 1.2) only.
    const Calibration folding = pinhole({-0.4});
    EXPECT_NEAR(radius_limit(folding), std::sqrt(1 / 1.2), 2e-3);
    EXPECT_FALSE(project(folding, {0.95, 0, -1}));
}

TEST(Calibration, FisheyeSeesBehindTheImagePlane) {
    Calibration c = fisheye({});
    c.focal = dvec2(200.0);
    const double angle = 1.7;  // past a right angle
    const auto pixel = project(c, {std::sin(angle), 0, -std::cos(angle)});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, c.centre.x + 200.0 * angle, 1e-9);
}

TEST(Calibration, ScalesWithThePicture) {
    const Calibration c = pinhole({-0.2, 0.04, 0.001, 0.0, 0.0});
    const auto half = scaled_to(c, {640, 360});
    ASSERT_TRUE(half);
    const dvec3 point(0.3, 0.2, -1.0);
    // Positions measured from the outer corner, half a pixel before the first centre, halve.
    EXPECT_NEAR(project(*half, point)->x + 0.5, (project(c, point)->x + 0.5) / 2, 1e-9);
    EXPECT_NEAR(project(*half, point)->y + 0.5, (project(c, point)->y + 0.5) / 2, 1e-9);
    EXPECT_FALSE(scaled_to(c, {640, 480}));
}

constexpr const char* good = R"({"format": "foveray-calibration", "version": 1, "model": "pinhole",
 "width": 640, "height": 480, "fx": 500, "fy": 510, "cx": 321, "cy": 238, "distortion": [-0.1, 0.02, 0.001, 0.002, 0.003],
 "head_from_camera": {"position": [0.01, 0.02, -0.05], "orientation": [0, 0, 0, 2]}, "latency_ms": 12.5})";

TEST(CalibrationFile, IsRead) {
    const fakes::TemporaryFolder folder;
    const Calibration c = read_calibration(folder.write("camera.json", good));
    EXPECT_EQ(c.model, LensModel::Pinhole);
    EXPECT_EQ(c.size, uvec2(640, 480));
    EXPECT_EQ(c.focal, dvec2(500, 510));
    EXPECT_EQ(c.centre, dvec2(321, 238));
    EXPECT_EQ(c.distortion, (std::array<double, 8>{-0.1, 0.02, 0.001, 0.002, 0.003, 0, 0, 0}));
    EXPECT_EQ(c.head_from_camera.position, vec3(0.01f, 0.02f, -0.05f));
    EXPECT_EQ(c.head_from_camera.orientation, quat(1, 0, 0, 0));
    EXPECT_EQ(c.latency, 12'500'000);
}

/// Replaces `from` by `to` in the good file and returns the message with which it is refused.
std::string refusal(const std::string& from, const std::string& to) {
    const fakes::TemporaryFolder folder;
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    try {
        read_calibration(folder.write("camera.json", text));
    } catch (const Fault& fault) {
        EXPECT_EQ(fault.code(), ExitCode::BadInput);
        return fault.what();
    }
    return "";
}

TEST(CalibrationFile, RefusalsNameThePlace) {
    const auto expect_names = [](const std::string& message, const std::string& place) {
        EXPECT_NE(message.find("camera.json"), std::string::npos) << message;
        EXPECT_NE(message.find(place), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    };
    expect_names(refusal("\"fx\": 500", "\"fx\": -1"), "/fx");
    expect_names(refusal("\"fx\": 500", "\"fx\": \"wide\""), "/fx");
    expect_names(refusal("\"fx\": 500,", ""), "fx");
    expect_names(refusal("\"version\": 1", "\"version\": 2"), "/version");
    expect_names(refusal("pinhole", "mirror"), "/model");
    expect_names(refusal("0.002, 0.003]", "0.002, 0.003, 0.004]"), "/distortion");
    expect_names(refusal("\"pinhole\"", "\"fisheye\""), "/distortion");
    expect_names(refusal("\"cx\": 321", "\"cx\": 9000"), "/cx");
    expect_names(refusal("[0, 0, 0, 2]", "[0, 0, 0, 0]"), "/head_from_camera");
    expect_names(refusal("[0, 0, 0, 2]", "[0, 0, 2]"), "/head_from_camera/orientation");
    expect_names(refusal("\"latency_ms\"", "\"delay\""), "delay");
    expect_names(refusal("\"height\": 480,", "\"height\" 480,"), ":2");
    EXPECT_THROW(read_calibration("no/such/camera.json"), Fault);
}

}  // namespace
}  // namespace foveray::passthrough
