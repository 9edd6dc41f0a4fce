#include "render/polar_map.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/math.h"

namespace foveray::render {
namespace {

using shared::polar_density;
using shared::polar_eccentricity;
using shared::polar_radius;

// 200 / (e + 1), HERR eq. 1.
Acuity herr(float outer, float cap) {
    return {.a = 200.0f, .b = 1.0f, .cap_ppd = cap, .outer_degrees = outer};
}
constexpr float uncapped = 1e6f;

TEST(PolarMap, IntegratesHerrsAcuityTo766SamplesAt45Degrees) {
    const auto map = make_polar_map(herr(45.0f, uncapped), 1.0f, 1.0f);
    EXPECT_NEAR(polar_radius(map, 45.0f), 200.0 * std::log(46.0), 1e-2);
    EXPECT_EQ(map.width, 766u);
}

TEST(PolarMap, CapOf60PixelsPerDegreeLeaves665Samples) {
    const auto map = make_polar_map(herr(45.0f, 60.0f), 1.0f, 1.0f);
    EXPECT_NEAR(map.knee, 200.0 / 60.0 - 1.0, 1e-5);
    EXPECT_NEAR(polar_radius(map, 45.0f), 140.0 + 200.0 * std::log(46.0 / (10.0 / 3.0)), 1e-2);
    EXPECT_EQ(map.width, 665u);
    EXPECT_FLOAT_EQ(polar_density(map, 0.5f), 60.0f);
    EXPECT_FLOAT_EQ(polar_density(map, 9.0f), 20.0f);
}

TEST(PolarMap, HerrsTableOneHas788RadialSamplesUpTo50Degrees) {
    const float outer = std::exp(788.0f / 200.0f) - 1.0f;
    EXPECT_NEAR(outer, 50.4f, 0.05f);
    const auto map = make_polar_map(herr(outer - 1e-3f, uncapped), 1.0f, 0.9746f);
    EXPECT_EQ(map.width, 788u);
    EXPECT_EQ(map.height, 768u);
}

TEST(PolarMap, RadiusAndEccentricityAreInverse) {
    for (float cap : {uncapped, 60.0f, 22.0f}) {
        const auto map = make_polar_map(herr(90.0f, cap), 1.0f, 1.0f);
        for (float e = 0.0f; e <= 90.0f; e += 0.37f) {
            EXPECT_NEAR(polar_eccentricity(map, polar_radius(map, e)), e, 1e-3f + 1e-5f * e) << cap;
        }
    }
}

TEST(PolarMap, RadialSpacingIsTheDerivativeOfTheInverse) {
    const auto map = make_polar_map(herr(90.0f, 60.0f), 0.8f, 1.0f);
    const float step = map.radius_outer / static_cast<float>(map.width);
    for (float r = 0.5f * step; r < map.radius_outer - step; r += 13.0f * step) {
        const float e = polar_eccentricity(map, r);
        const float measured = 0.5f * (polar_eccentricity(map, r + step) - polar_eccentricity(map, r - step));
        if (std::abs(e - map.knee) < 0.1f) continue;  // the derivative bends there
        EXPECT_NEAR(shared::polar_radial_spacing(map, e), measured, 1e-3f * measured + 2e-5f) << e;
    }
}

TEST(PolarMap, AngularSpacingIsTheCircleSharedOut) {
    const auto map = make_polar_map(herr(90.0f, 60.0f), 1.0f, 1.0f);
    EXPECT_NEAR(shared::polar_angular_spacing(map, 30.0f), 180.0f / static_cast<float>(map.height), 1e-4f);
    EXPECT_NEAR(shared::polar_angular_spacing(map, 90.0f), 360.0f / static_cast<float>(map.height), 1e-4f);
}

TEST(PolarMap, EqualDensityWouldNeed1173AngularSamples) {
    EXPECT_NEAR(equal_density_angular_samples(make_polar_map(herr(45.0f, uncapped), 1.0f, 1.0f)), 1173.0f,
                1.0f);
}

TEST(PolarMap, ScaleAppliesToBothAxes) {
    const auto full = make_polar_map(herr(90.0f, 60.0f), 1.0f, 0.9746f);
    const auto half = make_polar_map(herr(90.0f, 60.0f), 0.5f, 0.9746f);
    EXPECT_NEAR(half.width, 0.5 * full.width, 1.0);
    EXPECT_NEAR(half.height, 0.5 * full.height, 1.0);
    EXPECT_FLOAT_EQ(half.radius_outer, full.radius_outer);
}

TEST(PolarMap, WiderFoveaKeepsTheImageAndTheOuterEdge) {
    for (float cap : {uncapped, 60.0f}) {
        const auto map = make_polar_map(herr(90.0f, cap), 1.0f, 1.0f);
        const auto wide = widen_fovea(map, 10.0f);
        EXPECT_EQ(wide.width, map.width);
        EXPECT_EQ(wide.height, map.height);
        EXPECT_FLOAT_EQ(wide.radius_outer, map.radius_outer);
        EXPECT_NEAR(polar_radius(wide, 90.0f), map.radius_outer, 0.01f);
        EXPECT_FLOAT_EQ(polar_density(wide, 1.0f), polar_density(wide, 9.9f));
        EXPECT_GT(polar_density(wide, 10.0f), polar_density(map, 10.0f));
        EXPECT_LT(polar_density(wide, 0.0f), polar_density(map, 0.0f));
        EXPECT_NEAR(polar_eccentricity(wide, polar_radius(wide, 40.0f)), 40.0f, 1e-3f);
    }
}

TEST(PolarMap, WideningStartsFromTheMapItself) {
    const auto map = make_polar_map(herr(90.0f, 60.0f), 1.0f, 1.0f);
    EXPECT_FLOAT_EQ(widen_fovea(map, 0.0f).cap, map.cap);
    const auto barely = widen_fovea(map, map.knee + 1e-3f);
    EXPECT_NEAR(barely.cap, map.cap, 0.05f);
    EXPECT_NEAR(barely.a, map.a, 0.2f);
}

}  // namespace
}  // namespace foveray::render
