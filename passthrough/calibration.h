#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "base/math.h"
#include "base/time.h"

namespace foveray::passthrough {

using glm::dvec2;

/// How the direction to a point becomes a position on the sensor.
enum class LensModel : std::uint32_t {
    Pinhole = 0,  // OpenCV's: radial k1 k2 k3 / k4 k5 k6 (rational), tangential p1 p2
    Fisheye = 1,  // Kannala-Brandt, as cv::fisheye: odd polynomial in the angle to the axis, k1..k4
};

/// A camera's lens and place, as docs/camera-calibration.md describes the file. Pixel positions are OpenCV's:
/// (0, 0) is the centre of the top left pixel. The camera's frame is x right, y up, -z forward.
struct Calibration {
    LensModel model = LensModel::Pinhole;
    uvec2 size{0};                       // pixels
    dvec2 focal{0.0};                    // fx, fy in pixels
    dvec2 centre{0.0};                   // cx, cy in pixels
    std::array<double, 8> distortion{};  // pinhole: k1 k2 p1 p2 k3 k4 k5 k6; fisheye: k1 k2 k3 k4
    Pose head_from_camera;
    Nanoseconds latency = 0;  // from capture to availability
};

/// Throws Fault(BadInput) naming file and place: no such file, against docs/calibration.schema.json, a lens
/// whose centre lies outside its picture, a pose that is none.
Calibration read_calibration(const std::filesystem::path& file);

/// For a camera of which nothing is known: pinhole, 90 degrees horizontally, square pixels, at the head.
Calibration default_calibration(uvec2 size);

/// The same lens for a picture scaled to `size`; empty when the shape (width : height) differs by over 1 %.
std::optional<Calibration> scaled_to(const Calibration& calibration, uvec2 size);

/// Where the model is used: pinhole, the tangent of the angle to the axis; fisheye, the angle in radians.
/// Ends a little outside the picture's farthest corner, and in any case where the radial polynomial stops
/// growing.
double radius_limit(const Calibration& calibration);

/// Pixel position of a point in the camera's frame; it may lie outside the picture. Empty past radius_limit,
/// and behind a pinhole camera.
std::optional<dvec2> project(const Calibration& calibration, dvec3 point);

/// Unit direction in the camera's frame that projects to `pixel`. Empty when none within radius_limit does.
std::optional<dvec3> unproject(const Calibration& calibration, dvec2 pixel);

}  // namespace foveray::passthrough
