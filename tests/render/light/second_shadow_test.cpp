// Shadows on surfaces that are seen in a mirror and through glass, against the same surfaces seen directly.
#include <algorithm>
#include <cmath>

#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/light_rig.h"
#include "tests/render/light/test_scene.h"

namespace foveray::render {
namespace {

using SecondShadowTest = fakes::GpuTest;

constexpr Nanoseconds second = nanoseconds_per_second;
constexpr std::uint32_t pixels = 40;
const vec3 box_at(0.0f, 0.3f, 0.0f), box(0.15f, 0.1f, 0.2f);

/// Whether the box stands between a point and a lamp, by the slab method.
bool behind_box(vec3 p, vec3 lamp, float scale = 1.0f) {
    const vec3 d = lamp - p, a = (box_at - scale * box - p) / d, b = (box_at + scale * box - p) / d;
    const vec3 first = glm::min(a, b), last = glm::max(a, b);
    return std::max({first.x, first.y, first.z, 0.0f}) < std::min({last.x, last.y, last.z, 1.0f});
}

scene::Material glass(vec3 color, float ior) {
    scene::Material material = matte(color);
    material.roughness = 0.0f;
    material.transmission = 1.0f;
    material.ior = ior;
    material.solid = true;
    return material;
}

/// A floor and a box above it.
TestScene floor_and_box() {
    TestScene world;
    world.add(scene::make_rectangle(vec2(3.0f)), matte(vec3(0.8f)));
    world.add(scene::make_box(box), matte(vec3(0.5f)), {.position = box_at});
    return world;
}

/// A ring of lamps round the box, and one more; a shadow each.
std::vector<vec3> lamps() {
    std::vector<vec3> places;
    for (int i = 0; i < 8; ++i) {
        const float angle = 2.0f * pi * static_cast<float>(i) / 8.0f;
        places.emplace_back(0.8f * std::cos(angle), 1.2f, 0.8f * std::sin(angle));
    }
    places.emplace_back(0.1f, 1.5f, 0.1f);
    return places;
}

/// Of the first second nine balls of light, small enough for sharp shadows; then nine points. The last, whose
/// shadow there is no room for in the list, is the brightest.
void add_lamps(TestScene& world) {
    const std::vector<vec3> places = lamps();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const float strength = i == 8 ? 3.0f : 1.0f, radius = 0.004f;
        scene::Node ball, point;
        ball.local.translation = point.local.translation = places[i];
        ball.area_light = world.builder.add(scene::AreaLight{
            "ball", scene::AreaLightShape::Sphere, vec3(radius), vec3(strength / (pi * radius * radius))});
        point.light = world.builder.add(scene::Light{"point", scene::LightKind::Point, vec3(strength)});
        ball.present = {{0, second}};
        point.present = {{second, 2 * second}};
        world.builder.add(std::move(ball));
        world.builder.add(std::move(point));
    }
}

/// Light of every sample is that of its counterpart, by its colour; but for what lies on the edge of a
/// shadow.
void expect_like(const Rendered& found, const Rendered& direct, vec3 color, bool flipped) {
    int apart = 0, in_ninth = 0;
    float brightest = 0.0f;
    for (const auto& light : direct.light) brightest = std::max(brightest, light.radiance.x);
    for (std::uint32_t y = 0; y < pixels; ++y) {
        for (std::uint32_t x = 0; x < pixels; ++x) {
            const std::size_t there = std::size_t{y} * pixels + (flipped ? pixels - 1 - x : x);
            const vec3 expected = color * direct.light[there].radiance;
            apart +=
                glm::length(found.light[std::size_t{y} * pixels + x].radiance - expected) > 0.03f * brightest;
            in_ninth += behind_box(direct.surfaces[there].position, lamps()[8]);
        }
    }
    EXPECT_LT(apart, 30);
    EXPECT_GT(in_ninth, 100);
}

TEST_F(SecondShadowTest, AMirrorShowsTheShadows) {
    const vec3 color(1.0f, 0.8f, 0.6f);
    TestScene world = floor_and_box();
    world.add(scene::make_rectangle(vec2(3.0f)), metal(color, 0.0f),
              {glm::angleAxis(0.5f * pi, vec3(0.0f, 0.0f, 1.0f)), {1.0f, 0.0f, 0.0f}});
    add_lamps(world);
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot at_mirror, direct;  // the latter from behind the mirror, which has one side
    at_mirror.settings.ambient_occlusion_samples = direct.settings.ambient_occlusion_samples = 0;
    at_mirror.views = {square_view(15.0f, pixels, look_at({0.3f, 1.1f, 0.1f}, {1.9f, 0.0f, 0.0f}))};
    direct.views = {square_view(15.0f, pixels, look_at({1.7f, 1.1f, 0.1f}, {0.1f, 0.0f, 0.0f}))};
    for (const Nanoseconds time : {Nanoseconds{0}, second}) {
        at_mirror.time = direct.time = time;
        expect_like(rig.render(at_mirror), rig.render(direct), color, true);
    }
}

TEST_F(SecondShadowTest, GlassShowsTheShadows) {
    const vec3 color(0.9f, 1.0f, 0.8f);
    TestScene world = floor_and_box();
    const vec3 eye(0.1f, 1.9f, 1.5f), target(0.1f, 0.0f, 0.0f);
    // Bends nothing, and stands above the lamps.
    world.add(scene::make_box({0.2f, 0.2f, 0.02f}), glass(color, 1.0f),
              {look_at(eye, target).orientation, mix(eye, target, 0.1f)});
    add_lamps(world);
    const scene::Scene scene = world.build(), without = [] {
        TestScene bare = floor_and_box();
        add_lamps(bare);
        return bare.build();
    }();
    LightRig rig(device(), scene), bare_rig(device(), without);
    Shot shot;
    shot.settings.ambient_occlusion_samples = 0;
    shot.views = {square_view(10.0f, pixels, look_at(eye, target))};
    for (const Nanoseconds time : {Nanoseconds{0}, second}) {
        shot.time = time;
        expect_like(rig.render(shot), bare_rig.render(shot), color, false);
    }
}

// Through a slab of glass the shadow is seen where Snell's law says.
TEST_F(SecondShadowTest, GlassBendsWhereTheShadowIsSeen) {
    const float thickness = 0.3f, ior = 1.5f;
    const vec3 lamp(0.5f, 2.0f, 0.2f), eye(-0.7f, 1.6f, 0.2f);
    TestScene world = floor_and_box();
    world.add(scene::make_box({2.0f, 0.5f * thickness, 2.0f}), glass(vec3(1.0f), ior),
              {.position = {0.0f, 0.7f, 0.0f}});
    world.add(scene::Light{"lamp", scene::LightKind::Point, vec3(5.0f)}, Pose{.position = lamp});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    shot.settings.ambient_occlusion_samples = 0;
    shot.views = {square_view(20.0f, pixels, look_at(eye, {-0.1f, 0.0f, 0.0f}))};
    const Rendered rendered = rig.render(shot);
    int dark = 0, lit = 0;
    for (std::size_t i = 0; i < rendered.light.size(); ++i) {
        const vec3 entry = rendered.surfaces[i].position, d = glm::normalize(entry - eye),
                   inside = glm::refract(d, vec3(0.0f, 1.0f, 0.0f), 1.0f / ior),
                   exit = entry + thickness / -inside.y * inside, p = exit + exit.y / -d.y * d;
        if (behind_box(p, exit, 1.05f)) continue;  // the box itself is seen
        if (behind_box(p, lamp, 0.97f)) {
            EXPECT_LT(rendered.light[i].radiance.x, 1e-3f) << p.x << ' ' << p.z;
            ++dark;
        } else if (!behind_box(p, lamp, 1.03f)) {
            EXPECT_GT(rendered.light[i].radiance.x, 0.05f) << p.x << ' ' << p.z;
            ++lit;
        }
    }
    EXPECT_GT(dark, 50);
    EXPECT_GT(lit, 500);
}

}  // namespace
}  // namespace foveray::render
