#include "render/mesh_detail.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace foveray::render {
namespace {

constexpr std::array errors = {0.0f, 0.0005f, 0.001f, 0.002f, 0.004f, 0.008f};  // metres
constexpr scene::Aabb bounds{vec3(-0.1f), vec3(0.1f)};
const float radius = 0.1f * std::sqrt(3.0f);

/// Two eyes at the world's origin that look along -z.
MeshDetail detail(const Settings& settings = {}, bool every_pixel = false, vec3 gaze = {0, 0, -1}) {
    Frame frame;
    const float half = radians(45.0f);
    for (const Eye eye : {Eye::Left, Eye::Right}) {
        const float side = eye == Eye::Left ? -0.032f : 0.032f;
        frame.views.push_back({eye,
                               ViewRole::Context,
                               {quat(1, 0, 0, 0), vec3(side, 0, 0)},
                               {-half, half, half, -half},
                               {900, 900}});
    }
    return {
        frame,    {},         {vec3(0.0f), glm::normalize(gaze), 0.0f, true}, {200.0f, 1.0f, 60.0f, 60.0f},
        settings, every_pixel};
}

mat4 at(vec3 place, float scale = 1.0f) { return glm::scale(glm::translate(mat4(1.0f), place), vec3(scale)); }

vec3 towards(float degrees_off, float distance) {
    return distance * vec3(std::sin(radians(degrees_off)), 0.0f, -std::cos(radians(degrees_off)));
}

Settings without_mirrors() {
    Settings settings;
    settings.reflections = false;
    return settings;
}

TEST(MeshDetail, KeepsTheErrorBelowHalfASample) {
    const MeshDetail d = detail(without_mirrors());
    // At the gaze the density is 60 samples a degree.
    for (const float distance : {0.5f, 2.0f, 10.0f, 40.0f}) {
        const float allowed = d.allowed_error(towards(0.0f, distance), radius);
        const float nearest = distance - radius;
        EXPECT_LE(allowed, 1.005f * 0.5f * radians(1.0f / 60.0f) * nearest);  // eyes beside the origin
        EXPECT_GE(allowed, 0.45f * radians(1.0f / 60.0f) * nearest * 0.95f);
        const std::uint32_t level = d.level(errors, bounds, at(towards(0.0f, distance)));
        EXPECT_LE(errors[level], allowed);
        if (level + 1 < errors.size()) {
            EXPECT_GT(errors[level + 1], allowed);
        }
    }
    // Far off it, that of the acuity at its nearest point, less the margin: 200 / (e + 1).
    const float off = 40.0f, distance = 3.0f;
    const float e = off - degrees(std::asin(radius / distance)) - MeshDetail::gaze_margin;
    const float allowed = d.allowed_error(towards(off, distance), radius);
    EXPECT_NEAR(allowed, 0.5f * radians((e + 1.0f) / 200.0f) * (distance - radius), 0.06f * allowed);
}

TEST(MeshDetail, FollowsDistanceAndGaze) {
    const MeshDetail d = detail(without_mirrors());
    std::uint32_t before = 0;
    for (const float distance : {0.4f, 2.0f, 8.0f, 32.0f}) {
        const std::uint32_t level = d.level(errors, bounds, at(towards(0.0f, distance)));
        EXPECT_GE(level, before);
        before = level;
    }
    EXPECT_GT(before, 2u);
    EXPECT_GT(d.level(errors, bounds, at(towards(40.0f, 2.0f))),
              d.level(errors, bounds, at(towards(0.0f, 2.0f))));
    const MeshDetail aside = detail(without_mirrors(), false, towards(40.0f, 1.0f));
    EXPECT_LT(aside.level(errors, bounds, at(towards(40.0f, 2.0f))),
              d.level(errors, bounds, at(towards(40.0f, 2.0f))));
    EXPECT_EQ(d.level(errors, bounds, at(vec3(0.05f))), 0u) << "the eye is among it";
    // Twice as large is twice the error.
    EXPECT_LT(d.level(errors, bounds, at(towards(40.0f, 4.0f), 4.0f)),
              d.level(errors, bounds, at(towards(40.0f, 4.0f))));
}

TEST(MeshDetail, MirrorsBoundTheError) {
    const float with = detail().allowed_error(towards(50.0f, 3.0f), radius);
    const float without = detail(without_mirrors()).allowed_error(towards(50.0f, 3.0f), radius);
    EXPECT_LT(with, without);
    EXPECT_NEAR(with, 0.5f * MeshDetail::mirrored_error * radians(1.0f / 60.0f) * (3.0f - radius),
                0.05f * with);
}

TEST(MeshDetail, EveryPixelHasOneDensity) {
    const MeshDetail d = detail({}, true);
    EXPECT_NEAR(d.allowed_error(towards(0.0f, 3.0f), radius), d.allowed_error(towards(40.0f, 3.0f), radius),
                1e-4f);
}

TEST(MeshDetail, CanBeSwitchedOff) {
    Settings settings;
    settings.mesh_error = 0.0f;
    EXPECT_EQ(detail(settings).level(errors, bounds, at(towards(40.0f, 40.0f))), 0u);
    EXPECT_EQ(MeshDetail().level(errors, bounds, at(towards(40.0f, 40.0f))), 0u);
}

}  // namespace
}  // namespace foveray::render
