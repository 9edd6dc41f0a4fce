#include "render/sampling.h"

#include <algorithm>
#include <cmath>

#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/light_rig.h"
#include "tests/render/light/test_scene.h"

namespace foveray::render {
namespace {

using SamplingTest = fakes::GpuTest;

float angle_degrees(vec3 a, vec3 b) {
    return degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// Both eyes of a small headset, 64 mm apart.
Shot both_eyes(float half_angle_degrees, std::uint32_t pixels) {
    Shot shot;
    shot.every_pixel = false;
    shot.acuity = {.a = 30.0f, .b = 1.0f, .cap_ppd = 6.0f, .outer_degrees = 90.0f};
    for (const Eye eye : {Eye::Left, Eye::Right}) {
        View view = square_view(half_angle_degrees, pixels);
        view.eye = eye;
        view.stage_from_eye.position.x = eye == Eye::Left ? -0.032f : 0.032f;
        shot.views.push_back(view);
    }
    return shot;
}

/// The inside of a large box, unlit white.
scene::Scene closed_room() {
    TestScene world;
    scene::Material white = unlit(vec3(1.0f));
    white.double_sided = true;
    world.add(scene::make_box(vec3(5.0f)), white);
    return world.build();
}

TEST_F(SamplingTest, RaysFollowThePolarMap) {
    const scene::Scene scene = closed_room();
    LightRig rig(device(), scene);
    Shot shot = both_eyes(45.0f, 16);
    shot.fovea.direction = glm::normalize(vec3(0.2f, -0.3f, -1.0f));
    const Rendered rendered = rig.render(shot);
    const auto& map = rendered.grid.polar;
    ASSERT_EQ(rendered.surfaces.size(), 2u * map.width * map.height);
    std::size_t traced = 0;
    for (std::size_t i = 0; i < rendered.surfaces.size(); ++i) {
        const auto& surface = rendered.surfaces[i];
        if (surface.kind == shared::SURFACE_CULLED) continue;
        ++traced;
        const auto& gaze = rendered.gaze[i / (map.width * map.height)];
        const vec3 d = glm::normalize(surface.position - gaze.origin);
        const float radial = static_cast<float>(i % map.width) + 0.5f;
        const float angular = static_cast<float>(i / map.width % map.height) +
                              shared::polar_ring_start(static_cast<std::uint32_t>(i % map.width));
        const float e = angle_degrees(d, gaze.forward);
        EXPECT_NEAR(shared::polar_radius(map, e) * static_cast<float>(map.width) / map.radius_outer, radial,
                    0.02f);
        float angle = std::atan2(glm::dot(d, gaze.up), glm::dot(d, gaze.right));
        if (angle < 0.0f) angle += 2.0f * pi;
        EXPECT_NEAR(angle / (2.0f * pi) * static_cast<float>(map.height), angular, 0.05f);
        // The cone: as wide as the samples stand apart, and a little more.
        const float radial_spacing = radians(shared::polar_radial_spacing(map, e));
        const float angular_spacing = radians(shared::polar_angular_spacing(map, e));
        const float across = std::clamp(angular_spacing, 0.6f * radial_spacing, radial_spacing);
        EXPECT_NEAR(surface.footprint / surface.distance, 1.3f * std::sqrt(radial_spacing * across),
                    0.02f * radial_spacing);
    }
    EXPECT_EQ(rendered.rays[shared::COUNT_PRIMARY], traced);
    EXPECT_LT(traced, rendered.surfaces.size()) << "directions that no view shows are not traced";

    shot.views = both_eyes(8.0f, 16).views;
    EXPECT_LT(rig.render(shot).rays[shared::COUNT_PRIMARY], traced / 2);
}

TEST_F(SamplingTest, EachEyesGazeMeetsTheFixationPoint) {
    TestScene world;
    world.add(scene::make_box({2.0f, 2.0f, 0.1f}), unlit(vec3(1.0f)), {.position = {0.0f, 0.0f, -0.8f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = both_eyes(40.0f, 4);
    shot.fovea.direction = glm::normalize(vec3(0.1f, 0.05f, -1.0f));
    const Rendered rendered = rig.render(shot);
    const vec3 fixation = shot.fovea.direction * (0.7f / -shot.fovea.direction.z);
    for (int eye = 0; eye < 2; ++eye) {
        const auto& gaze = rendered.gaze[eye];
        EXPECT_EQ(gaze.origin, shot.views[eye].stage_from_eye.position);
        EXPECT_LT(angle_degrees(gaze.forward, fixation - gaze.origin), 0.05f);
        EXPECT_NEAR(gaze.distance, glm::length(fixation - gaze.origin), 2e-3f);
        EXPECT_NEAR(glm::dot(gaze.right, gaze.forward), 0.0f, 1e-5f);
        EXPECT_NEAR(glm::dot(gaze.right, gaze.up), 0.0f, 1e-5f);
        EXPECT_GT(gaze.right.x, 0.9f);
        EXPECT_GT(gaze.up.y, 0.9f);
    }
    EXPECT_GT(angle_degrees(rendered.gaze[0].forward, rendered.gaze[1].forward), 4.0f) << "the eyes converge";
}

TEST_F(SamplingTest, FixationDistanceIsSmoothAcrossAnEdge) {
    TestScene world;
    world.add(scene::make_box({1.0f, 1.0f, 0.05f}), unlit(vec3(1.0f)), {.position = {-1.1f, 0.0f, -1.05f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = both_eyes(40.0f, 4);
    const vec3 at_box = glm::normalize(vec3(-0.5f, 0.0f, -1.0f)), at_nothing(0.0f, 0.0f, -1.0f);
    const auto inverse_distance = [&](vec3 direction, Nanoseconds time) {
        shot.fovea.direction = direction;
        shot.time = time;
        const auto gaze = rig.render(shot).gaze;
        return 1.0f / (0.5f * (gaze[0].distance + gaze[1].distance));
    };
    const float near = 1.0f / std::sqrt(1.25f), far = 1.0f / SamplingStage::far_distance;
    EXPECT_NEAR(inverse_distance(at_box, 0), near, 0.01f) << "the first frame takes what it finds";
    const float share = std::exp(-20.0f / 60.0f);
    const Nanoseconds step = 20 * nanoseconds_per_millisecond;
    EXPECT_NEAR(inverse_distance(at_nothing, step), far + (near - far) * share, 0.01f);
    EXPECT_NEAR(inverse_distance(at_nothing, 2 * step), far + (near - far) * share * share, 0.01f);
    EXPECT_NEAR(inverse_distance(at_nothing, 60 * step), far, 0.01f);
}

/// Smooth, of more than a sample's width.
vec3 pattern(vec3 d) {
    return 0.5f + 0.4f * vec3(std::sin(7.0f * d.x + 2.0f * d.y), std::cos(6.0f * d.y - 3.0f * d.z), 0.0f);
}

// Nothing that a pixel needs may be culled: every visible pixel shows its part of a pattern, which what is
// left of its neighbours would not.
TEST_F(SamplingTest, CullingLeavesNoHoles) {
    const scene::Scene scene = closed_room();
    LightRig rig(device(), scene);
    Shot shot = both_eyes(40.0f, 64);
    shot.acuity.a = 60.0f;
    shot.paint = [](vec3 direction, float distance) {
        return shared::LightSample{pattern(direction), 1.0f, vec3(1.0f), distance, vec3(0.0f), 1.0f};
    };
    const HiddenMesh corner{.vertices = {{-1, 0}, {0, 1}, {-1, 1}}, .indices = {0, 1, 2}, .version = 1};
    const vec3 gazes[] = {{0.0f, 0.0f, -1.0f}, {-0.65f, 0.5f, -1.0f}, {0.84f, -0.3f, -1.0f}};
    std::uint64_t unmasked = 0;
    for (const bool masked : {false, true}) {
        shot.hidden = masked ? std::vector<HiddenMesh>{corner, corner} : std::vector<HiddenMesh>{};
        std::uint64_t rays = 0;
        for (const vec3 gaze : gazes) {
            shot.fovea.direction = glm::normalize(gaze);
            const Rendered rendered = rig.render(shot);
            rays += rendered.rays[shared::COUNT_PRIMARY];
            float worst = 0.0f;
            for (std::size_t eye = 0; eye < 2; ++eye) {
                int hidden = 0;
                for (std::uint32_t i = 0; i < 64 * 64; ++i) {
                    const Pixel& pixel = rendered.views[eye].pixels[i];
                    if (!pixel.visible) {
                        ++hidden;
                        continue;
                    }
                    ASSERT_NEAR(pixel.coverage, 1.0f, 2e-3f);
                    const vec3 expected = pattern(direction_of(shot.views[eye], i % 64, i / 64));
                    worst = std::max(worst, glm::length(pixel.radiance - expected));
                }
                // Half a square of 0.678 in the picture's 1.678, less the cells on its diagonal.
                const double expected = masked ? 0.5 * std::pow(0.678 / 1.678, 2.0) * 64 * 64 : 0.0;
                EXPECT_NEAR(hidden, expected, 0.25 * expected);
            }
            EXPECT_LT(worst, 0.02f) << masked << ' ' << gaze.x;
        }
        if (!masked) unmasked = rays;
    }
    shot.fovea.direction = glm::normalize(gazes[1]);  // into the hidden corner
    const std::uint64_t rays = rig.render(shot).rays[shared::COUNT_PRIMARY];
    shot.hidden.clear();
    EXPECT_LT(rays, rig.render(shot).rays[shared::COUNT_PRIMARY]);
    EXPECT_GT(unmasked, 0u);
}

TEST_F(SamplingTest, EveryPixelOfEveryViewIsASample) {
    const scene::Scene scene = closed_room();
    LightRig rig(device(), scene);
    Shot shot = both_eyes(30.0f, 8);
    shot.every_pixel = true;
    shot.views.push_back(shot.views[0]);
    shot.views.push_back(shot.views[1]);
    shot.views[2].role = shot.views[3].role = ViewRole::Focus;
    shot.views[2].fov = {radians(-20.0f), radians(10.0f), radians(8.0f), radians(-12.0f)};
    shot.views[2].size = {7, 5};
    const Rendered rendered = rig.render(shot);
    ASSERT_EQ(rendered.surfaces.size(), 64u + 64u + 35u + 64u);
    std::size_t i = 0;
    for (const View& view : shot.views) {
        for (std::uint32_t y = 0; y < view.size.y; ++y) {
            for (std::uint32_t x = 0; x < view.size.x; ++x, ++i) {
                const vec3 to_hit = rendered.surfaces[i].position - view.stage_from_eye.position;
                EXPECT_LT(angle_degrees(to_hit, direction_of(view, x, y)), 1e-3f) << x << ' ' << y;
            }
        }
    }
}

}  // namespace
}  // namespace foveray::render
