// Penumbras that are sampled where it counts, against all samples everywhere and against closed forms.
#include <algorithm>
#include <cmath>

#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/shadow_quality.h"
#include "tests/render/light/test_scene.h"

namespace foveray::render {
namespace {

using PenumbraTest = fakes::GpuTest;
using scene::AreaLightShape;

constexpr vec3 primaries[] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
constexpr Nanoseconds second = nanoseconds_per_second;

scene::Material glass_sheet(vec3 tint) {
    scene::Material material = matte(tint);
    material.transmission = 1.0f;
    material.double_sided = true;
    return material;
}

/// A light that is there until a moment.
void add_light(TestScene& world, AreaLightShape shape, vec3 at, vec3 target, vec3 radiance, vec3 half_size,
               std::vector<scene::Presence> present = {}) {
    const Pose pose = look_at(at, target);
    scene::Node node;
    node.area_light = world.builder.add(scene::AreaLight{"lamp", shape, half_size, radiance});
    node.local.translation = pose.position;
    node.local.rotation = pose.orientation;
    node.present = std::move(present);
    world.builder.add(std::move(node));
}

void add_floor(TestScene& world) { world.add(scene::make_rectangle(vec2(3.0f)), matte(vec3(0.8f))); }

/// Bars thinner than a light, and boxes. Nothing round: where smooth normals hide that a surface has turned
/// away from the light, a hundredth of it tells little.
void add_clutter(TestScene& world) {
    for (const vec3 at : {vec3(-0.5f, 0.5f, 0.0f), vec3(-0.35f, 0.3f, 0.0f)})
        world.add(scene::make_box({0.02f, 0.02f, 0.6f}), matte(vec3(0.5f)), {.position = at});
    world.add(scene::make_box({0.2f, 0.15f, 0.05f}), matte(vec3(0.5f)),
              {glm::angleAxis(0.7f, vec3(0.4f, 0.8f, 0.45f)), {0.4f, 0.4f, 0.2f}});
    world.add(scene::make_box({0.1f, 0.2f, 0.1f}), matte(vec3(0.5f)), {.position = {0.1f, 0.2f, -0.4f}});
}

Shot at_the_floor(std::uint32_t pixels) {
    Shot shot;
    shot.views = {square_view(25.0f, pixels, look_at({0.0f, 1.5f, 1.2f}, vec3(0.0f)))};
    return shot;
}

/// Both eyes' polar images, looking down at a point of the floor.
Shot polar_at_the_floor(vec3 target) {
    Shot shot;
    shot.every_pixel = false;
    shot.acuity = {.a = 50.0f, .b = 1.0f, .cap_ppd = 10.0f, .outer_degrees = 20.0f};
    for (const Eye eye : {Eye::Left, Eye::Right}) {
        View view = square_view(11.0f, 4, look_at(target + vec3(0.0f, 1.5f, 0.0f), target));
        view.eye = eye;
        shot.views.push_back(view);
    }
    shot.fovea.origin = shot.views[0].stage_from_eye.position;
    shot.fovea.direction = vec3(0.0f, -1.0f, 0.0f);
    return shot;
}

float greatest_difference(const Seen& a, const Seen& b) {
    float most = 0.0f;
    for (std::size_t i = 0; i < a.part.size(); ++i)
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a.part[i][c] - b.part[i][c]));
    return most;
}

int differing(const Seen& a, const Seen& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.part.size(); ++i) count += a.part[i] != b.part[i];
    return count;
}

constexpr float rounding = 1e-5f;

/// What is in a penumbra is as if all samples had been taken everywhere; what looks decided is lit or dark.
void expect_all_taken(LightRig& rig, const Shot& shot, int samples) {
    const Seen all = seen(rig, shot, samples, false), adaptive = seen(rig, shot, samples, true);
    EXPECT_LT(adaptive.rays, all.rays);
    int penumbra = 0, missed = 0;
    for (std::size_t i = 0; i < all.part.size(); ++i) {
        const float found = adaptive.part[i].x, expected = all.part[i].x;
        penumbra += expected > rounding && expected < 1.0f - rounding;
        if (std::abs(found - expected) < rounding) continue;
        EXPECT_TRUE(found < rounding || found > 1.0f - rounding) << i << ": " << found;
        ++missed;
    }
    EXPECT_GT(penumbra, 100);
    EXPECT_LT(missed, penumbra / 20);
}

// A half plane of coloured glass over half the light: what arrives is the part of the light that is seen
// beside it and the rest in its colour. Where light has come through a colour all samples are taken, so
// nothing may differ.
TEST_F(PenumbraTest, ColouredShadowsAreThoseOfAllSamples) {
    const vec3 tint(0.9f, 0.4f, 0.1f);
    const float edge = 0.05f, edge_height = 0.8f, lamp_height = 1.6f, half = 0.2f;
    TestScene world;
    add_floor(world);
    world.add(scene::make_rectangle(vec2(1.0f)), glass_sheet(tint),
              {.position = {edge + 1.0f, edge_height, 0.0f}});
    add_light(world, AreaLightShape::Rectangle, {0.0f, lamp_height, 0.0f}, vec3(0.0f), vec3(4.0f),
              vec3(half));
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    shot.views = {square_view(20.0f, 40, look_at({-0.4f, 0.75f, 0.0f}, {-0.1f, 0.0f, 0.0f}))};
    const std::vector<shared::Surface> surfaces = rig.render(shot).surfaces;
    for (const int sub_samples : {1, 4}) {
        shot.settings.reference_samples = sub_samples;
        for (const int samples : {16, 64, 256}) {
            const Seen all = seen(rig, shot, samples, false), adaptive = seen(rig, shot, samples, true);
            // Of 64 only the half that comes first may have met no glass.
            EXPECT_LE(differing(all, adaptive), std::ssize(all.part) / 50) << sub_samples << ' ' << samples;
            EXPECT_LE(greatest_difference(all, adaptive), 1.0f / 64.0f) << sub_samples << ' ' << samples;
            EXPECT_LT(adaptive.rays, all.rays);
            int between = 0;
            for (std::size_t i = 0; i < surfaces.size(); ++i) {
                const vec3 p = surfaces[i].position;
                if (std::abs(p.y) > 1e-4f) continue;
                const float x = p.x + (edge - p.x) * lamp_height / edge_height;
                const float open = std::clamp((x + half) / (2.0f * half), 0.0f, 1.0f);
                const vec3 expected = mix(tint, vec3(1.0f), open);
                EXPECT_LT(glm::length(adaptive.part[i] - expected), samples == 16 ? 0.2f : 0.08f) << p.x;
                between += open > 0.1f && open < 0.9f;
            }
            EXPECT_GT(between, 200);
        }
    }
}

TEST_F(PenumbraTest, EachOfTwoOrThreeLightsHasItsOwn) {
    TestScene world;
    add_floor(world);
    add_clutter(world);
    add_light(world, AreaLightShape::Rectangle, {0.3f, 1.8f, 0.2f}, vec3(0.0f), primaries[0],
              {0.25f, 0.2f, 0.1f});
    add_light(world, AreaLightShape::Box, {-0.6f, 1.5f, 0.3f}, vec3(0.0f), primaries[1], {0.2f, 0.1f, 0.15f});
    add_light(world, AreaLightShape::Sphere, {0.1f, 1.6f, -0.7f}, vec3(0.0f), primaries[2], vec3(0.2f),
              {{0, second}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = at_the_floor(40);
    expect_adaptive_as_good(rig, shot, 3, 1024);
    shot.time = second;
    expect_adaptive_as_good(rig, shot, 2, 1024);
    shot.time = 0;
    shot.settings.reference_samples = 4;
    expect_adaptive_as_good(rig, shot, 3, 1024, {64});
}

// Elsewhere than in 64 or 256 samples they are taken by one thread: the same ones.
TEST_F(PenumbraTest, FewSamplesAreAllTaken) {
    TestScene world;
    add_floor(world);
    add_clutter(world);
    add_light(world, AreaLightShape::Box, {0.3f, 1.8f, 0.2f}, vec3(0.0f), vec3(4.0f), {0.25f, 0.2f, 0.1f});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    for (const int samples : {16, 128}) expect_all_taken(rig, at_the_floor(32), samples);
}

TEST_F(PenumbraTest, BothPolarImagesHaveTheirs) {
    TestScene world;
    add_floor(world);
    add_clutter(world);
    add_light(world, AreaLightShape::Rectangle, {0.3f, 1.8f, 0.2f}, vec3(0.0f), primaries[0],
              {0.25f, 0.2f, 0.1f});
    add_light(world, AreaLightShape::Box, {-0.6f, 1.5f, 0.3f}, vec3(0.0f), primaries[1], {0.2f, 0.1f, 0.15f});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    const Shot shot = polar_at_the_floor({-0.1f, 0.0f, 0.0f});
    expect_adaptive_as_good(rig, shot, 2, 1024, {64});
    expect_all_taken(rig, shot, 16);
}

// The shadow of a quarter of a plane, its corner under the gaze, has two edges. One of them lies where the
// last row of the polar image meets the first, or neither does: neighbours on both sides of an edge tell of
// it.
TEST_F(PenumbraTest, ThePolarImagesSeamIsNoBorder) {
    std::uint64_t found[2] = {};
    for (const int turned : {0, 1}) {
        TestScene world;
        add_floor(world);
        const quat turn = glm::angleAxis(0.25f * pi * static_cast<float>(turned), vec3(0.0f, 1.0f, 0.0f));
        scene::Node plane;
        scene::Mesh mesh = scene::make_box({1.5f, 0.001f, 1.5f});
        mesh.primitives[0].material = world.builder.add(matte(vec3(0.5f)));
        plane.mesh = world.builder.add(std::move(mesh));
        plane.local.translation = turn * vec3(1.5f, 0.0f, -1.5f) + vec3(0.0f, 2.0f, 0.0f);
        plane.local.rotation = turn;
        plane.present = {{0, second}};
        world.builder.add(std::move(plane));
        add_light(world, AreaLightShape::Sphere, {0.0f, 3.0f, 0.0f}, vec3(0.0f), vec3(4e5f), vec3(1e-4f));
        const scene::Scene scene = world.build();
        LightRig rig(device(), scene);
        Shot shot = polar_at_the_floor(vec3(0.0f));
        const Seen shadowed = seen(rig, shot, 64, true);
        shot.time = second;
        found[turned] = shadowed.rays - seen(rig, shot, 64, true).rays;
        const auto dark = std::ranges::count(shadowed.part, vec3(0.0f));
        EXPECT_GT(dark, 1000);
    }
    EXPECT_GT(found[0], 10000u);
    EXPECT_NEAR(static_cast<double>(found[0]), static_cast<double>(found[1]),
                0.1 * static_cast<double>(found[1]));
}

// What the shadow stage has no room for is found where it is shaded, from the same samples.
TEST_F(PenumbraTest, TheNinthLightHasThePenumbraOfTheFirst) {
    TestScene world;
    add_floor(world);
    add_clutter(world);
    for (int i = 0; i < 8; ++i) {
        const float angle = 0.25f * pi * static_cast<float>(i);
        add_light(world, AreaLightShape::Rectangle, {std::cos(angle), 1.5f, std::sin(angle)}, vec3(0.0f),
                  primaries[0], vec3(0.2f), {{0, second}});
    }
    add_light(world, AreaLightShape::Rectangle, {0.3f, 1.8f, 0.2f}, vec3(0.0f), primaries[1],
              {0.25f, 0.2f, 0.1f});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = at_the_floor(32);
    const Seen ninth = seen(rig, shot, 64, true);
    shot.time = second;
    const Seen first = seen(rig, shot, 64, false);
    int penumbra = 0;
    for (std::size_t i = 0; i < first.part.size(); ++i) {
        EXPECT_NEAR(ninth.part[i].y, first.part[i].y, 2e-3f) << i;  // the shadow stage packs what it finds
        penumbra += first.part[i].y > 0.0f && first.part[i].y < 1.0f;
    }
    EXPECT_GT(penumbra, 100);
}

// A light that the floor cuts in half, behind a wall or not: where the one sample falls on the lower half,
// which does not shine here, it tells nothing.
TEST_F(PenumbraTest, ALoneSampleBelowTheHorizonIsTakenAgain) {
    TestScene world;
    add_floor(world);
    scene::Node wall;
    scene::Mesh mesh = scene::make_box({0.01f, 1.0f, 2.0f});
    mesh.primitives[0].material = world.builder.add(matte(vec3(0.0f)));
    wall.mesh = world.builder.add(std::move(mesh));
    wall.local.translation = {0.7f, 0.0f, 0.0f};
    wall.present = {{0, second}};
    world.builder.add(std::move(wall));
    add_light(world, AreaLightShape::Rectangle, {1.0f, 0.0f, 0.0f}, vec3(0.0f), vec3(4.0f),
              {0.3f, 0.3f, 0.0f});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    shot.views = {square_view(20.0f, 24, look_at({0.0f, 1.0f, 0.0f}, vec3(0.0f)))};
    for (const float expected : {0.0f, 1.0f}) {
        const Seen found = seen(rig, shot, 1, false);
        for (const vec3 part : found.part)
            EXPECT_LT(glm::distance(part, vec3(expected)), rounding) << expected;
        shot.time = second;
    }
}

}  // namespace
}  // namespace foveray::render
