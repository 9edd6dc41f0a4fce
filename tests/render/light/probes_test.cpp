#include "render/probes.h"

#include <algorithm>
#include <cstring>
#include <numbers>

#include "render/reference/path_tracer.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/light_rig.h"
#include "tests/render/light/test_scene.h"

namespace foveray::render {
namespace {

constexpr double frame_seconds = 0.1;
constexpr float matte_mirror = 0.0157f;  // part of all light that a matte() surface mirrors: specular_albedo

Nanoseconds nanoseconds(double seconds) { return static_cast<Nanoseconds>(seconds * 1e9); }

/// A rectangle that faces along `normal`, of half sizes along two of the world's axes.
void add_wall(TestScene& world, vec3 center, vec3 normal, vec2 half_size, const scene::Material& material) {
    const vec3 fallback = std::abs(normal.y) > 0.9f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const vec3 x = fallback, z = glm::cross(x, normal);
    world.add(scene::make_rectangle(half_size), material, {glm::quat_cast(mat3(x, normal, z)), center});
}

/// The inner sides of a box.
void add_room(TestScene& world, vec3 min, vec3 max, const scene::Material& material) {
    const vec3 c = 0.5f * (min + max), h = 0.5f * (max - min);
    add_wall(world, {c.x, min.y, c.z}, {0, 1, 0}, {h.x, h.z}, material);
    add_wall(world, {c.x, max.y, c.z}, {0, -1, 0}, {h.x, h.z}, material);
    add_wall(world, {min.x, c.y, c.z}, {1, 0, 0}, {h.y, h.z}, material);
    add_wall(world, {max.x, c.y, c.z}, {-1, 0, 0}, {h.y, h.z}, material);
    add_wall(world, {c.x, c.y, min.z}, {0, 0, 1}, {h.y, h.x}, material);
    add_wall(world, {c.x, c.y, max.z}, {0, 0, -1}, {h.y, h.x}, material);
}

/// A lamp that shines down.
void add_lamp(TestScene& world, vec3 center, vec2 half_size, float radiance) {
    world.add(
        scene::AreaLight{"lamp", scene::AreaLightShape::Rectangle, vec3(half_size, 0.0f), vec3(radiance)},
        look_at(center, center - vec3(0, 1, 0)));
}

class ProbesTest : public fakes::GpuTest {
  protected:
    /// A picture after so many frames of a scene that rests.
    Rendered settle(LightRig& rig, Shot& shot, int frames, double seconds_a_frame = frame_seconds) {
        const std::vector<View> views = std::move(shot.views);
        shot.read_samples = false;
        shot.views = {square_view(1.0f, 1)};
        for (int i = 1; i < frames; ++i) {
            rig.render(shot);
            shot.time += nanoseconds(seconds_a_frame);
        }
        shot.read_samples = true;
        shot.views = views;
        Rendered rendered = rig.render(shot);
        shot.time += nanoseconds(seconds_a_frame);
        return rendered;
    }

    std::vector<shared::ProbeState> states(const LightRig& rig) {
        const shared::ProbeField& field = rig.probes().field();
        return read_back<shared::ProbeState>(rig.probes().states(),
                                             std::size_t{field.count_x} * field.count_y * field.count_z);
    }

    static Shot shot_from(const Pose& pose, float half_angle, std::uint32_t pixels) {
        Shot shot;
        shot.views = {square_view(half_angle, pixels, pose)};
        shot.settings.reflections = false;
        shot.settings.shadow_samples = 4;
        shot.settings.ambient_occlusion_samples = 0;  // the path tracer knows no such thing
        return shot;
    }
};

float mean(vec3 v) { return (v.x + v.y + v.z) / 3.0f; }

/// The part of each colour that a surface sends back: diffuse, and what it mirrors, which probes take to be
/// diffuse too.
vec3 all_reflected(vec3 color) { return (1.0f - matte_mirror) * color + matte_mirror; }

/// Open to the front; `part` makes a surface's base colour of its colour.
scene::Scene cornell_box(vec3 (*part)(vec3)) {
    TestScene world;
    const scene::Material white = matte(part(vec3(0.7f)));
    add_wall(world, {0, 0, 0}, {0, 1, 0}, {1, 1}, white);
    add_wall(world, {0, 2, 0}, {0, -1, 0}, {1, 1}, white);
    add_wall(world, {0, 1, -1}, {0, 0, 1}, {1, 1}, white);
    add_wall(world, {-1, 1, 0}, {1, 0, 0}, {1, 1}, matte(part({0.6f, 0.06f, 0.05f})));
    add_wall(world, {1, 1, 0}, {-1, 0, 0}, {1, 1}, matte(part({0.1f, 0.45f, 0.08f})));
    world.add(scene::make_box(vec3(0.3f)), white,
              {glm::angleAxis(0.3f, vec3(0, 1, 0)), vec3(0.35f, 0.3f, 0.3f)});
    world.add(scene::make_box(vec3(0.3f, 0.6f, 0.3f)), white,
              {glm::angleAxis(-0.3f, vec3(0, 1, 0)), vec3(-0.35f, 0.6f, -0.3f)});
    add_lamp(world, {0, 1.98f, 0}, {0.25f, 0.25f}, 15.0f);
    world.builder.set(scene::ProbeGrid{{8, 8, 8}, vec3(-1, 0, -1), vec3(1, 2, 1)});
    return world.build();
}

// What the probes add to a surface, against path tracing.
TEST_F(ProbesTest, IndirectLightIsThatOfThePathTracer) {
    const scene::Scene scene = cornell_box([](vec3 color) { return color; });
    LightRig rig(device(), scene);
    Shot shot = shot_from({.position = vec3(0, 1, 3.6f)}, 19.3f, 9);
    const Rendered with = settle(rig, shot, 50);
    shot.settings.probes = false;
    const Rendered without = rig.render(shot);

    const scene::Scene same = cornell_box(all_reflected);
    scene::SceneAnimator animator(same);
    const reference::PathTracer reference(same, animator.advance(0));
    dvec3 sum(0.0), expected_sum(0.0);
    int points = 0, far_off = 0;
    for (std::size_t i = 0; i < with.light.size(); ++i) {
        const shared::Surface& surface = with.surfaces[i];
        if (surface.kind != shared::SURFACE_VIRTUAL) continue;
        const vec3 added = with.light[i].radiance - without.light[i].radiance;
        const dvec3 found(added * pi / ((1.0f - matte_mirror) * surface.base_color));
        const dvec3 expected = reference.indirect_irradiance(surface.position, surface.normal, 400);
        sum += found;
        expected_sum += expected;
        ++points;
        far_off += std::abs(mean(vec3(found)) / mean(vec3(expected)) - 1.0f) > 0.2f;
    }
    ASSERT_GT(points, 60);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / expected_sum[c], 1.0, 0.05) << "channel " << c;
    EXPECT_LE(far_off, points / 8);  // corners darken within less than the probes' spacing
}

TEST_F(ProbesTest, WhiteThingsInEvenLightVanish) {
    TestScene world(vec3(1.0f));
    world.add(scene::make_rectangle(vec2(2.0f)), matte(vec3(1.0f)));
    world.add(scene::make_sphere(0.4f, 24), matte(vec3(1.0f)), {.position = vec3(0.5f, 0.5f, 0.0f)});
    world.add(scene::make_box(vec3(0.3f)), matte(vec3(1.0f)), {.position = vec3(-0.5f, 0.3f, 0.2f)});
    world.builder.set(scene::ProbeGrid{{6, 4, 6}, vec3(-1.2f, 0, -1.2f), vec3(1.2f, 1.2f, 1.2f)});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = shot_from(look_at({0, 1.0f, 2.5f}, {0, 0.3f, 0}), 25.0f, 12);
    const Rendered rendered = settle(rig, shot, 30);
    for (const shared::LightSample& sample : rendered.light) {
        if (sample.coverage == 0.0f) continue;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sample.radiance[c], 1.0f, 0.015f);
    }
}

// Every surface sends out e and reflects a part: all is e / (1 - part), after endlessly many bounces.
TEST_F(ProbesTest, AClosedRoomKeepsItsLight) {
    TestScene world;
    scene::Material glowing = matte(vec3(0.7f));
    const float part = 0.7f * (1.0f - matte_mirror) + matte_mirror;
    glowing.emissive = vec3(1.0f - part);
    add_room(world, vec3(-1.0f), vec3(1.0f), glowing);
    world.builder.set(scene::ProbeGrid{{4, 4, 4}, vec3(-1.0f), vec3(1.0f)});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = shot_from({}, 40.0f, 4);
    const Rendered rendered = settle(rig, shot, 80);
    for (const shared::LightSample& sample : rendered.light) {
        // The mirror part of what is seen comes from the environment, which is dark.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sample.radiance[c], 1.0f - matte_mirror, 0.015f);
    }
}

TEST_F(ProbesTest, NoLightLeaksThroughAThinWall) {
    TestScene world;
    add_room(world, {-2, 0, -1}, {2, 2, 1}, matte(vec3(0.8f)));
    world.add(scene::make_box({0.01f, 1.0f, 1.0f}), matte(vec3(0.8f)), {.position = vec3(0, 1, 0)});
    add_lamp(world, {-1, 1.95f, 0}, {0.3f, 0.3f}, 10.0f);
    world.builder.set(scene::ProbeGrid{{10, 5, 5}, vec3(-2, 0, -1), vec3(2, 2, 1)});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot lit = shot_from(look_at({-1.9f, 1, 0}, {0, 1, 0}), 40.0f, 6);
    const Rendered bright = settle(rig, lit, 40);
    Shot dark = shot_from(look_at({1.9f, 1, 0}, {0, 1, 0}), 40.0f, 6);
    dark.time = lit.time;
    const Rendered behind = rig.render(dark);
    float light = 0.0f, leak = 0.0f;
    for (std::size_t i = 0; i < behind.light.size(); ++i) {
        light += mean(bright.light[i].radiance) / static_cast<float>(behind.light.size());
        leak = std::max(leak, mean(behind.light[i].radiance));
    }
    EXPECT_GT(light, 0.3f);
    EXPECT_LT(leak, 0.01f * light);
}

TEST_F(ProbesTest, ProbesMoveOutOfThingsOrSleepInThem) {
    TestScene world(vec3(1.0f));
    // Cells of 0.5 m: the box holds the innermost 4 x 4 x 4 probes, of which the outer ones are 0.1 m below
    // its surface and the innermost 0.6 m.
    const float half = 0.85f;
    world.add(scene::make_box(vec3(half)), matte(vec3(0.5f)));
    world.builder.set(scene::ProbeGrid{{12, 12, 12}, vec3(-2.875f), vec3(2.875f)});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = shot_from({.position = vec3(0, 0, 5)}, 10.0f, 1);
    shot.settings.probe_rays = 48;
    settle(rig, shot, 30);
    const auto found = states(rig);
    const shared::ProbeField& field = rig.probes().field();
    int moved = 0, inside = 0, asleep = 0, awake = 0;
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        const vec3 rest = field.first + field.spacing * vec3(i % 12, i / 12 % 12, i / 144);
        const vec3 from_middle = glm::abs(rest), at = glm::abs(rest + found[i].offset);
        const float place = std::max({from_middle.x, from_middle.y, from_middle.z});
        const float now = std::max({at.x, at.y, at.z});
        const std::uint32_t flags = found[i].flags;
        if (place < 0.3f) {
            ++inside;
            EXPECT_TRUE(flags & shared::PROBE_INSIDE);
        } else if (place < half) {
            ++moved;
            EXPECT_FALSE(flags & shared::PROBE_INSIDE);
            EXPECT_GT(now, half) << "probe " << i;
        } else if (place > half + 1.0f) {
            ++asleep;
            EXPECT_TRUE(flags & shared::PROBE_ASLEEP) << "probe " << i;
            EXPECT_EQ(found[i].offset, vec3(0.0f));
        } else {
            ++awake;
        }
    }
    EXPECT_EQ(inside, 8);
    EXPECT_EQ(moved, 56);
    EXPECT_GT(asleep, 700);
    EXPECT_GT(awake, 100);

    const auto rays_of = [&](bool sleeping) {
        shot.settings.probe_sleeping = sleeping;
        shot.time += nanoseconds(frame_seconds);
        return rig.render(shot).rays[shared::COUNT_PROBE];
    };
    EXPECT_LT(rays_of(true), found.size() * 48 / 2);
    EXPECT_EQ(rays_of(false), found.size() * 48);
}

TEST_F(ProbesTest, AStepInTheLightArrivesAfterTheSameTimeAtAnyRate) {
    TestScene world(vec3(1.0f));
    world.add(scene::make_rectangle(vec2(1.0f)), matte(vec3(0.5f)));
    world.builder.set(scene::ProbeGrid{{3, 2, 3}, vec3(-1, 0, -1), vec3(1, 1, 1)});
    const scene::Scene scene = world.build();
    for (const double rate : {30.0, 90.0}) {
        LightRig rig(device(), scene);
        Shot shot = shot_from(look_at({0, 1.5f, 0}, {0, 0, 0}), 10.0f, 2);
        const float before = settle(rig, shot, 30, 1.0 / rate).light[0].radiance.x;
        const auto after = [&](double seconds) {
            return settle(rig, shot, static_cast<int>(seconds * rate + 0.5), 1.0 / rate).light[0].radiance.x;
        };
        shot.settings.environment_intensity = 4.0f;
        EXPECT_GT(after(0.1) / before, 1.0f + 3.0f * 0.85f) << rate;
        EXPECT_GT(after(0.5) / before, 1.0f + 3.0f * 0.95f) << rate;
        shot.settings.environment_intensity = 4.2f;  // too small a step to be taken for one
        EXPECT_LT(after(0.1) / before, 4.1f) << rate;
        EXPECT_GT(after(1.0) / before, 4.13f) << rate;
    }
}

TEST_F(ProbesTest, AStillSceneComesToRest) {
    TestScene world;
    add_room(world, vec3(-1.0f), vec3(1.0f), matte(vec3(0.6f)));
    add_lamp(world, {0.3f, 0.97f, 0}, {0.3f, 0.3f}, 10.0f);
    world.add(scene::make_sphere(0.3f, 16), matte({0.9f, 0.2f, 0.1f}), {.position = vec3(0.2f, -0.4f, 0.2f)});
    world.builder.set(scene::ProbeGrid{{4, 4, 4}, vec3(-1.0f), vec3(1.0f)});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = shot_from(look_at({-0.9f, 0, 0}, {1, 0, 0}), 40.0f, 6);
    // Time runs fast until all has settled, then at 90 Hz over a whole cycle of rotations.
    const Rendered first = settle(rig, shot, 300);
    float largest = 0.0f;
    for (std::uint32_t i = 0; i < shared::PROBE_ROTATIONS; ++i) {
        shot.time += nanoseconds(1.0 / 90.0);
        const Rendered next = rig.render(shot);
        for (std::size_t s = 0; s < next.light.size(); ++s) {
            largest = std::max(largest, mean(glm::abs(next.light[s].radiance - first.light[s].radiance)) /
                                            mean(first.light[s].radiance));
        }
    }
    EXPECT_LT(largest, 0.002f);
    RecordProperty("largest change", std::to_string(largest));
}

TEST_F(ProbesTest, DirectionsAreEvenAndRotationsTurnThem) {
    const std::vector<vec3> directions = probe_directions(128);
    vec3 sum(0.0f);
    float to_next = 0.0f;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        EXPECT_NEAR(glm::length(directions[i]), 1.0f, 1e-5f);
        sum += directions[i];
        if (i > 0) to_next += glm::distance(directions[i], directions[i - 1]) / 127.0f;
    }
    EXPECT_LT(glm::length(sum), 0.5f);
    EXPECT_LT(to_next, 0.6f);  // any order: 1.33
    vec3 turned(0.0f);
    for (std::uint32_t i = 0; i < shared::PROBE_ROTATIONS; ++i) {
        EXPECT_NEAR(glm::length(probe_rotation(i)), 1.0f, 1e-5f);
        turned += probe_rotation(i) * vec3(0, 1, 0) / float{shared::PROBE_ROTATIONS};
    }
    EXPECT_LT(glm::length(turned), 0.1f);
    EXPECT_EQ(probe_rotation(3), probe_rotation(3 + shared::PROBE_ROTATIONS));
}

}  // namespace
}  // namespace foveray::render
