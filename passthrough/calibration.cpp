#include "passthrough/calibration.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/json.h"
#include "embedded/calibration_schema.h"

namespace foveray::passthrough {
namespace {

/// The distorted radius for an undistorted one (pinhole: tangents; fisheye: angle to tangent-plane radius).
double distorted_radius(const Calibration& c, double r) {
    const auto& k = c.distortion;
    const double r2 = r * r;
    if (c.model == LensModel::Fisheye) return r * (1 + r2 * (k[0] + r2 * (k[1] + r2 * (k[2] + r2 * k[3]))));
    return r * (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
}

dvec2 normalised(const Calibration& c, dvec2 pixel) { return (pixel - c.centre) / c.focal; }

/// The distorted position of an undistorted one, without the limit: both on the plane at distance 1, y down.
dvec2 distort(const Calibration& c, dvec2 p) {
    const double r = glm::length(p);
    const double scale = r > 0 ? distorted_radius(c, r) / r : 1.0;
    if (c.model == LensModel::Fisheye) return p * scale;
    const double p1 = c.distortion[2], p2 = c.distortion[3];
    return p * scale + dvec2(2 * p1 * p.x * p.y + p2 * (r * r + 2 * p.x * p.x),
                             p1 * (r * r + 2 * p.y * p.y) + 2 * p2 * p.x * p.y);
}

/// Position on the model's plane: pinhole, the tangents; fisheye, the angle along the direction's azimuth.
std::optional<dvec2> undistorted_position(const Calibration& c, dvec3 point) {
    const dvec2 side(point.x, -point.y);
    if (c.model == LensModel::Pinhole) {
        if (point.z >= 0) return std::nullopt;
        return side / -point.z;
    }
    const double distance = glm::length(side);
    if (distance == 0) return point.z < 0 ? std::optional(dvec2(0)) : std::nullopt;
    return side * (std::atan2(distance, -point.z) / distance);
}

dvec3 direction_of(const Calibration& c, dvec2 p) {
    if (c.model == LensModel::Pinhole) return glm::normalize(dvec3(p.x, -p.y, -1));
    const double angle = glm::length(p);
    const dvec2 side = angle > 0 ? p * (std::sin(angle) / angle) : dvec2(0);
    return {side.x, -side.y, -std::cos(angle)};
}

dvec3 read_dvec3(const Json& json) {
    return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

}  // namespace

Calibration read_calibration(const std::filesystem::path& file) {
    const Json json = read_json(file);
    check_json(json, calibration_schema, file);

    Calibration c;
    c.model = json.at("model") == "fisheye" ? LensModel::Fisheye : LensModel::Pinhole;
    c.size = {json.at("width").get<unsigned>(), json.at("height").get<unsigned>()};
    c.focal = {json.at("fx").get<double>(), json.at("fy").get<double>()};
    c.centre = {json.at("cx").get<double>(), json.at("cy").get<double>()};
    if (c.centre.x < 0 || c.centre.y < 0 || c.centre.x > c.size.x || c.centre.y > c.size.y) {
        throw_bad_input(file.string() + ": /cx", "the lens's centre lies outside the picture",
                        "give cx and cy in pixels of a picture of width × height");
    }
    if (json.contains("distortion")) {
        const Json& distortion = json.at("distortion");
        const std::size_t n = distortion.size();
        const bool fits = n == 0 || n == 4 || (c.model == LensModel::Pinhole && (n == 5 || n == 8));
        if (!fits) {
            throw_bad_input(file.string() + ": /distortion", "has " + std::to_string(n) + " numbers",
                            c.model == LensModel::Pinhole
                                ? "a pinhole lens takes 4, 5 or 8: k1 k2 p1 p2 k3 k4 k5 k6"
                                : "a fisheye lens takes 4: k1 k2 k3 k4");
        }
        std::transform(distortion.begin(), distortion.end(), c.distortion.begin(),
                       [](const Json& value) { return value.get<double>(); });
    }
    if (json.contains("head_from_camera")) {
        const Json& pose = json.at("head_from_camera");
        c.head_from_camera.position = read_dvec3(pose.at("position"));
        const Json& q = pose.at("orientation");
        c.head_from_camera.orientation =
            quat(q[3].get<float>(), q[0].get<float>(), q[1].get<float>(), q[2].get<float>());
        if (!is_usable(c.head_from_camera)) {
            throw_bad_input(file.string() + ": /head_from_camera", "not a pose",
                            "give metres, and a quaternion x, y, z, w of length 1");
        }
        c.head_from_camera.orientation = glm::normalize(c.head_from_camera.orientation);
    }
    c.latency = from_seconds(json.value("latency_ms", 0.0) * 1e-3);
    return c;
}

Calibration default_calibration(uvec2 size) {
    Calibration c;
    c.size = size;
    c.focal = dvec2(size.x / 2.0);
    c.centre = (dvec2(size) - 1.0) / 2.0;
    return c;
}

std::optional<Calibration> scaled_to(const Calibration& calibration, uvec2 size) {
    const dvec2 scale = dvec2(size) / dvec2(calibration.size);
    if (std::abs(scale.x / scale.y - 1) > 0.01) return std::nullopt;
    Calibration c = calibration;
    c.size = size;
    c.focal *= scale;
    c.centre = (c.centre + 0.5) * scale - 0.5;
    return c;
}

double radius_limit(const Calibration& c) {
    const dvec2 last = dvec2(c.size) - 1.0;
    double corner = 0;
    for (const dvec2 pixel : {dvec2(0), dvec2(last.x, 0), dvec2(0, last.y), last}) {
        corner = std::max(corner, glm::length(normalised(c, pixel)));
    }
    // The tangential terms move a corner by a few percent at most.
    const double wanted = 1.1 * corner;
    const double step = 1e-3;
    const double end = c.model == LensModel::Fisheye ? pi : 50.0;
    double r = 0, distorted = 0;
    while (r < end && distorted < wanted) {
        const double next = distorted_radius(c, r + step);
        if (!(next > distorted)) break;
        distorted = next;
        r += step;
    }
    return r;
}

std::optional<dvec2> project(const Calibration& c, dvec3 point) {
    const auto position = undistorted_position(c, point);
    if (!position || glm::length(*position) > radius_limit(c)) return std::nullopt;
    return distort(c, *position) * c.focal + c.centre;
}

std::optional<dvec3> unproject(const Calibration& c, dvec2 pixel) {
    const dvec2 wanted = normalised(c, pixel);
    const double limit = radius_limit(c);
    // Newton's method from the position with the right radius; the radial part dominates every real lens.
    double low = 0, high = limit;
    for (int i = 0; i < 30; ++i) {
        const double middle = (low + high) / 2;
        (distorted_radius(c, middle) < glm::length(wanted) ? low : high) = middle;
    }
    const double length = glm::length(wanted);
    dvec2 p = length > 0 ? wanted * (high / length) : dvec2(0);
    for (int i = 0; i < 20; ++i) {
        const dvec2 error = distort(c, p) - wanted;
        if (glm::length(error) < 1e-12) break;
        const double h = 1e-7;
        const dvec2 dx = (distort(c, p + dvec2(h, 0)) - distort(c, p - dvec2(h, 0))) / (2 * h);
        const dvec2 dy = (distort(c, p + dvec2(0, h)) - distort(c, p - dvec2(0, h))) / (2 * h);
        const double determinant = dx.x * dy.y - dx.y * dy.x;
        if (determinant == 0) return std::nullopt;
        p -= dvec2(dy.y * error.x - dy.x * error.y, dx.x * error.y - dx.y * error.x) / determinant;
    }
    if (!(glm::length(distort(c, p) - wanted) < 1e-6) || glm::length(p) > limit) return std::nullopt;
    return direction_of(c, p);
}

}  // namespace foveray::passthrough
