#include "render/lighting.h"

#include <cmath>

#include "shaders/shared/room.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/light_rig.h"
#include "tests/render/light/test_scene.h"

namespace foveray::render {
namespace {

using LightingTest = fakes::GpuTest;
using glm::dvec3;

void expect_near(vec3 found, vec3 expected, float relative, const std::string& where) {
    const float tolerance = relative * std::max({expected.x, expected.y, expected.z, 1e-3f});
    EXPECT_LE(glm::length(found - expected), tolerance)
        << where << ": " << found.x << ' ' << found.y << ' ' << found.z << " against " << expected.x << ' '
        << expected.y << ' ' << expected.z;
}

/// glTF 2.0, appendix B, written down a second time.
dvec3 gltf_brdf(dvec3 base, double metallic, double roughness, dvec3 n, dvec3 v, dvec3 l) {
    const dvec3 h = glm::normalize(l + v);
    const double a2 = std::pow(roughness, 4.0);
    const double nl = glm::dot(n, l), nv = glm::dot(n, v), nh = glm::dot(n, h), vh = glm::dot(v, h);
    const dvec3 f0 = glm::mix(dvec3(0.04), base, metallic);
    const dvec3 f = f0 + (1.0 - f0) * std::pow(1.0 - vh, 5.0);
    const double d = a2 / (pi * std::pow(nh * nh * (a2 - 1.0) + 1.0, 2.0));
    const auto g = [&](double x) { return 2.0 * x / (x + std::sqrt(a2 + (1.0 - a2) * x * x)); };
    return (1.0 - f) * base * (1.0 - metallic) / double{pi} + f * d * g(nl) * g(nv) / (4.0 * nl * nv);
}

/// Irradiance of a rectangle of radiance 1 by summing over its area.
double rectangle_irradiance(dvec3 center, dvec3 half_u, dvec3 half_v, dvec3 point, dvec3 normal) {
    constexpr int steps = 200;
    const dvec3 light_normal = glm::normalize(glm::cross(half_u, half_v));
    const double cell = 4.0 * glm::length(glm::cross(half_u, half_v)) / (steps * steps);
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const dvec3 way = center + ((2.0 * i + 1.0) / steps - 1.0) * half_u +
                              ((2.0 * j + 1.0) / steps - 1.0) * half_v - point;
            const double d2 = glm::dot(way, way);
            sum += cell * std::max(glm::dot(way, normal), 0.0) * std::max(-glm::dot(way, light_normal), 0.0) /
                   (d2 * d2);
        }
    }
    return sum;
}

/// Looks down at the floor from 2 m.
Shot looking_down(std::uint32_t pixels = 12) {
    Shot shot;
    shot.views = {square_view(25.0f, pixels, look_at({0.0f, 2.0f, 0.0f}, vec3(0.0f)))};
    return shot;
}

TEST_F(LightingTest, PunctualLightsFollowTheirClosedForms) {
    TestScene world;
    const vec3 base(0.6f, 0.4f, 0.2f);
    scene::Material material = metal(base, 0.4f);
    material.metallic = 0.3f;
    world.add(scene::make_rectangle(vec2(3.0f)), material);
    const vec3 point_at(0.5f, 1.5f, 0.2f), spot_at(-1.0f, 2.0f, 0.3f), sun_from(1.0f, 2.0f, -0.5f);
    const vec3 point(10.0f, 8.0f, 6.0f), spot(20.0f), sun(1.0f, 2.0f, 3.0f);
    const float inner = 0.2f, outer = 0.5f, range = 3.0f;
    world.add(scene::Light{"point", scene::LightKind::Point, point, range}, Pose{.position = point_at});
    world.add(scene::Light{"spot", scene::LightKind::Spot, spot, 0.0f, inner, outer},
              look_at(spot_at, vec3(0.0f)));
    world.add(scene::Light{"sun", scene::LightKind::Directional, sun}, look_at(sun_from, vec3(0.0f)));
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    const Shot shot = looking_down();
    const Rendered rendered = rig.render(shot);

    const dvec3 n(0.0, 1.0, 0.0);
    for (std::size_t i = 0; i < rendered.light.size(); ++i) {
        const dvec3 p(rendered.surfaces[i].position);
        const dvec3 v = glm::normalize(dvec3(shot.views[0].stage_from_eye.position) - p);
        dvec3 expected(0.0);
        const auto add = [&](dvec3 irradiance, dvec3 l) {
            expected += irradiance * glm::dot(n, l) * gltf_brdf(base, 0.3, 0.4, n, v, l);
        };
        const dvec3 to_point = dvec3(point_at) - p, to_spot = dvec3(spot_at) - p;
        const double d = glm::length(to_point);
        add(dvec3(point) * std::max(1.0 - std::pow(d / range, 4.0), 0.0) / (d * d), to_point / d);
        const double cosine = glm::dot(glm::normalize(to_spot), glm::normalize(dvec3(spot_at)));
        const double inside = std::clamp(
            (cosine - std::cos(double{outer})) / (std::cos(double{inner}) - std::cos(double{outer})), 0.0,
            1.0);
        add(dvec3(spot) * inside * inside / glm::dot(to_spot, to_spot), glm::normalize(to_spot));
        add(dvec3(sun), glm::normalize(dvec3(sun_from)));
        expect_near(rendered.light[i].radiance, vec3(expected), 2e-3f, "sample " + std::to_string(i));
        EXPECT_EQ(rendered.light[i].coverage, 1.0f);
    }
    EXPECT_EQ(rendered.rays[shared::COUNT_PRIMARY], rendered.light.size());
    EXPECT_GT(rendered.rays[shared::COUNT_SHADOW], 2 * rendered.light.size());
}

// White and black floors differ by their diffuse parts alone, which is the irradiance.
TEST_F(LightingTest, AreaLightGivesTheIrradianceOfARectangle) {
    // High above, tilted; and one that the floor's horizon cuts.
    const Pose poses[] = {look_at({0.3f, 1.2f, 0.1f}, {0.0f, 0.0f, 0.3f}),
                          look_at({0.8f, 0.1f, 0.0f}, {-1.0f, 0.2f, 0.3f})};
    const vec2 half(0.5f, 0.3f);
    for (const Pose& pose : poses) {
        std::vector<Rendered> rendered;
        const Shot shot = looking_down();
        for (const float albedo : {1.0f, 0.0f}) {
            TestScene world;
            world.add(scene::make_rectangle(vec2(3.0f)), matte(vec3(albedo)));
            world.add(
                scene::AreaLight{"lamp", scene::AreaLightShape::Rectangle, vec3(half, 0.0f), vec3(4.0f)},
                pose);
            const scene::Scene scene = world.build();
            rendered.push_back(LightRig(device(), scene).render(shot));
        }
        const dvec3 u = dvec3(pose.orientation * vec3(half.x, 0.0f, 0.0f));
        const dvec3 v = dvec3(pose.orientation * vec3(0.0f, -half.y, 0.0f));
        for (std::size_t i = 0; i < rendered[0].light.size(); ++i) {
            const dvec3 p(rendered[0].surfaces[i].position), n(0.0, 1.0, 0.0);
            const dvec3 view = glm::normalize(dvec3(0.0, 2.0, 0.0) - p);
            const dvec3 h = glm::normalize(glm::normalize(dvec3(pose.position) - p) + view);
            const double before_light = glm::dot(p - dvec3(pose.position), glm::normalize(glm::cross(u, v)));
            if (std::abs(before_light) < 0.15) continue;  // too near to be summed up
            const double fresnel = 0.04 + 0.96 * std::pow(1.0 - glm::dot(view, h), 5.0);
            const double expected =
                4.0 * rectangle_irradiance(pose.position, u, v, p, n) * (1.0 - fresnel) / pi;
            const double found = rendered[0].light[i].radiance.x - rendered[1].light[i].radiance.x;
            EXPECT_NEAR(found, expected, 0.01 * expected + 1e-3) << i;
        }
    }
}

TEST_F(LightingTest, PointLightCastsASharpShadow) {
    TestScene world;
    world.add(scene::make_rectangle(vec2(3.0f)), matte(vec3(0.8f)));
    const vec3 lamp(0.4f, 1.5f, 0.0f), box_at(0.0f, 0.5f, 0.0f), box(0.15f, 0.1f, 0.2f);
    world.add(scene::make_box(box), matte(vec3(0.5f)), {.position = box_at});
    world.add(scene::Light{"lamp", scene::LightKind::Point, vec3(5.0f)}, Pose{.position = lamp});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    const Rendered rendered = rig.render(looking_down(48));
    int dark = 0, lit = 0;
    for (std::size_t i = 0; i < rendered.light.size(); ++i) {
        const vec3 p = rendered.surfaces[i].position;
        if (std::abs(p.y) > 1e-4f) continue;
        const auto blocked = [&](float scale) {  // by the slab method
            const vec3 d = lamp - p, a = (box_at - scale * box - p) / d, b = (box_at + scale * box - p) / d;
            const vec3 first = glm::min(a, b), last = glm::max(a, b);
            return std::max({first.x, first.y, first.z}) < std::min({last.x, last.y, last.z});
        };
        if (blocked(0.97f)) {
            ++dark;
            EXPECT_EQ(rendered.light[i].radiance, vec3(0.0f)) << i;
        } else if (!blocked(1.03f)) {
            ++lit;
            EXPECT_GT(rendered.light[i].radiance.x, 0.05f) << i;
        }
    }
    EXPECT_GT(dark, 50);
    EXPECT_GT(lit, 500);
}

// A half plane over half the light: the penumbra is the part of the light that is seen.
TEST_F(LightingTest, AreaLightCastsASoftShadow) {
    TestScene world;
    world.add_real(scene::make_rectangle(vec2(3.0f)), vec3(0.5f));
    const float edge = 0.05f, edge_height = 0.8f, lamp_height = 1.6f, half = 0.2f;
    world.add(scene::make_box({1.0f, 0.001f, 1.0f}), matte(vec3(0.5f)),
              {.position = {edge + 1.0f, edge_height, 0.0f}});
    world.add(scene::AreaLight{"lamp", scene::AreaLightShape::Rectangle, vec3(half), vec3(4.0f)},
              look_at({0.0f, lamp_height, 0.0f}, vec3(0.0f)));
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    shot.views = {square_view(20.0f, 40, look_at({-0.4f, 0.75f, 0.0f}, {-0.1f, 0.0f, 0.0f}))};
    shot.settings.shadow_samples = 64;
    const Rendered rendered = rig.render(shot);
    int between = 0;
    for (std::size_t i = 0; i < rendered.light.size(); ++i) {
        const vec3 p = rendered.surfaces[i].position;
        if (rendered.surfaces[i].kind != shared::SURFACE_REAL) continue;
        // Where the line from p over the edge meets the light.
        const float x = p.x + (edge - p.x) * lamp_height / edge_height;
        const float seen = std::clamp((x + half) / (2.0f * half), 0.0f, 1.0f);
        EXPECT_NEAR(rendered.light[i].transmittance.x, seen, 0.06f) << p.x;
        between += seen > 0.1f && seen < 0.9f;
    }
    EXPECT_GT(between, 200);
}

// A closed room of light of radiance 1 in every direction: nothing may be brighter.
TEST_F(LightingTest, WhiteFurnace) {
    for (const float roughness : {0.0f, 0.3f, 1.0f}) {
        TestScene world(vec3(1.0f));
        world.add(scene::make_rectangle(vec2(1.0f, 3.0f)), metal(vec3(1.0f), roughness),
                  {.position = {-1.0f, 0, 0}});
        scene::Material dielectric = matte(vec3(1.0f));
        dielectric.roughness = roughness;
        world.add(scene::make_rectangle(vec2(1.0f, 3.0f)), dielectric, {.position = {1.0f, 0, 0}});
        const scene::Scene scene = world.build();
        LightRig rig(device(), scene);
        const Rendered rendered = rig.render(looking_down());
        for (std::size_t i = 0; i < rendered.light.size(); ++i) {
            const bool is_metal = rendered.surfaces[i].metallic == 1.0f;
            const float radiance = rendered.light[i].radiance.x;
            EXPECT_LE(radiance, 1.001f) << roughness;
            // Rough metal: single scattering loses the rest.
            EXPECT_GE(radiance, is_metal && roughness > 0.0f ? 0.4f : 0.99f) << roughness;
        }
    }
}

// The same for light from lamps: a thousand suns make a sky of radiance 1, and the sum is the BRDF's albedo.
TEST_F(LightingTest, WhiteFurnaceOfManySuns) {
    constexpr int rows = 24, columns = 48;
    std::vector<vec3> suns;
    for (int i = 0; i < rows * columns; ++i) {
        const float height = (static_cast<float>(i / columns) + 0.5f) / rows;  // equal areas of the sphere
        const float angle = 2.0f * pi * (static_cast<float>(i % columns) + 0.5f) / columns;
        const float side = std::sqrt(1.0f - height * height);
        suns.emplace_back(side * std::cos(angle), height, side * std::sin(angle));
    }
    const float irradiance = 2.0f * pi / (rows * columns);
    for (const float roughness : {0.4f, 1.0f}) {
        TestScene world;
        world.add(scene::make_rectangle(vec2(3.0f)), metal(vec3(1.0f), roughness));
        for (const vec3 sun : suns) {
            world.add(scene::Light{"sun", scene::LightKind::Directional, vec3(irradiance)},
                      look_at(sun, vec3(0.0f)));
        }
        const scene::Scene scene = world.build();
        LightRig rig(device(), scene);
        Shot shot;
        shot.settings.shadows = false;
        for (const float tilt : {0.0f, 0.8f}) {
            const vec3 eye(0.0f, std::cos(tilt), std::sin(tilt));
            shot.views = {square_view(1.0f, 1, look_at(2.0f * eye, vec3(0.0f)))};
            double albedo = 0.0;
            for (const vec3 sun : suns) {
                albedo += double{irradiance} * double{sun.y} *
                          gltf_brdf(dvec3(1.0), 1.0, double{roughness}, {0.0, 1.0, 0.0}, eye, sun).x;
            }
            const float radiance = rig.render(shot).light[0].radiance.x;
            EXPECT_NEAR(radiance, albedo, 2e-3) << roughness << ' ' << tilt;
            EXPECT_LE(radiance, 1.0f) << roughness << ' ' << tilt;
            EXPECT_GE(radiance, roughness < 0.5f ? 0.9f : 0.2f) << tilt;
        }
    }
}

TEST_F(LightingTest, AmbientOcclusionAndIntensityScaleTheEnvironment) {
    TestScene world(vec3(0.5f, 1.0f, 2.0f));
    world.add(scene::make_rectangle(vec2(3.0f)), matte(vec3(1.0f)));
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = looking_down(4);
    shot.settings.environment_intensity = 3.0f;
    expect_near(rig.render(shot).light[0].radiance, vec3(1.5f, 3.0f, 6.0f), 0.01f, "environment");
}

TEST_F(LightingTest, MirrorShowsWhatStandsBeforeIt) {
    TestScene world(vec3(0.2f));
    world.add(scene::make_rectangle(vec2(3.0f)), metal(vec3(1.0f, 0.8f, 0.6f), 0.0f));
    // A wall behind the floor's far end, seen at 45 degrees down.
    world.add(scene::make_box({3.0f, 3.0f, 0.01f}), unlit({0.1f, 0.5f, 0.9f}),
              {.position = {0.0f, 0.0f, -3.0f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    shot.views = {square_view(3.0f, 4, look_at({0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, -1.0f}))};
    const Rendered mirrored = rig.render(shot);
    const vec3 expected = vec3(0.1f, 0.5f, 0.9f) * vec3(1.0f, 0.8f, 0.6f);
    expect_near(mirrored.light[0].radiance, expected, 0.03f, "mirror");
    EXPECT_EQ(mirrored.rays[shared::COUNT_REFLECTION], mirrored.light.size());

    shot.settings.reflections = false;
    const Rendered environment_only = rig.render(shot);
    expect_near(environment_only.light[0].radiance, 0.2f * vec3(1.0f, 0.8f, 0.6f), 0.03f, "environment");
    EXPECT_EQ(environment_only.rays[shared::COUNT_REFLECTION], 0u);
}

TEST_F(LightingTest, UnlitAndEmissiveNeedNoLight) {
    TestScene world;
    world.add(scene::make_rectangle(vec2(0.5f, 3.0f)), unlit({0.3f, 0.2f, 0.1f}),
              {.position = {-0.5f, 0, 0}});
    scene::Material glowing = matte(vec3(0.0f));
    glowing.emissive = {2.0f, 3.0f, 4.0f};
    world.add(scene::make_rectangle(vec2(0.5f, 3.0f)), glowing, {.position = {0.5f, 0, 0}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    const Rendered rendered = rig.render(looking_down(4));
    expect_near(rendered.light[0].radiance, {0.3f, 0.2f, 0.1f}, 5e-4f, "unlit");
    expect_near(rendered.light[3].radiance, {2.0f, 3.0f, 4.0f}, 1e-4f, "emissive");
}

TEST_F(LightingTest, SeeThroughLayersStackFrontToBack) {
    TestScene world;
    const vec3 front(1.0f, 0.0f, 0.0f), middle(0.0f, 1.0f, 0.0f), back(0.0f, 0.0f, 1.0f);
    world.add(scene::make_rectangle(vec2(3.0f)), unlit(front, 0.5f), {.position = {0.0f, 1.0f, 0.0f}});
    world.add(scene::make_rectangle(vec2(3.0f)), unlit(middle, 0.25f), {.position = {0.0f, 0.5f, 0.0f}});
    world.add(scene::make_rectangle(vec2(0.4f, 3.0f)), unlit(back), {.position = {-0.4f, 0.0f, 0.0f}});
    world.add_real(scene::make_rectangle(vec2(0.4f, 3.0f)), vec3(0.5f), 0.0f, 0.0f,
                   {.position = {0.4f, 0.0f, 0.0f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = looking_down(4);
    Rendered rendered = rig.render(shot);
    expect_near(rendered.light[1].radiance, {0.5f, 0.125f, 0.375f}, 1e-3f, "over an opaque surface");
    EXPECT_NEAR(rendered.light[1].coverage, 1.0f, 1e-4f);
    expect_near(rendered.light[2].radiance, {0.5f, 0.125f, 0.0f}, 1e-3f, "over a real surface");
    EXPECT_NEAR(rendered.light[2].coverage, 0.625f, 1e-4f);
    EXPECT_NEAR(rendered.light[2].distance, rendered.surfaces[2].distance, 0.0f);
    EXPECT_EQ(rendered.rays[shared::COUNT_TRANSPARENT], 2 * rendered.light.size());

    shot.settings.max_transparent_layers = 1;
    rendered = rig.render(shot);
    expect_near(rendered.light[1].radiance, {0.5f, 0.0f, 0.0f}, 1e-3f, "one layer");
    EXPECT_NEAR(rendered.light[1].coverage, 0.5f, 1e-4f);
}

// A pane of half coverage over a real floor in a virtual shadow keeps that shadow for the half that is seen.
TEST_F(LightingTest, RealSurfaceTakesShadowAsARatio) {
    const vec3 ambient(0.2f, 0.4f, 0.6f), sun(1.0f);
    TestScene world(ambient);
    world.add_real(scene::make_rectangle(vec2(3.0f)), vec3(0.5f));
    world.add(scene::Light{"sun", scene::LightKind::Directional, sun},
              look_at({0.0f, 1.0f, 0.0f}, vec3(0.0f)));
    world.add(scene::make_box({1.0f, 0.01f, 1.0f}), matte(vec3(0.5f)), {.position = {1.0f, 2.5f, 0.0f}});
    world.add(scene::make_rectangle(vec2(3.0f)), unlit(vec3(1.0f), 0.5f), {.position = {0.0f, 0.5f, 2.8f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    const Rendered rendered = rig.render(looking_down(16));
    const vec3 ratio = pi * ambient / (pi * ambient + sun);
    int in_shadow = 0, in_sun = 0, under_pane = 0;
    for (std::size_t i = 0; i < rendered.light.size(); ++i) {
        const auto& light = rendered.light[i];
        const vec3 p = rendered.surfaces[i].position;
        if (p.y > 0.1f) {
            EXPECT_NEAR(light.coverage, 0.5f, 1e-4f);
            ++under_pane;
        } else {
            EXPECT_EQ(light.coverage, 0.0f);
            const bool shadow = p.x > 0.0f;
            expect_near(light.transmittance, shadow ? ratio : vec3(1.0f), 2e-3f, "transmittance");
            ++(shadow ? in_shadow : in_sun);
        }
        EXPECT_EQ(light.added, vec3(0.0f));
    }
    EXPECT_GT(in_shadow, 40);
    EXPECT_GT(in_sun, 40);
    EXPECT_GT(under_pane, 10);
}

TEST_F(LightingTest, RealMirrorAddsVirtualThingsOnly) {
    TestScene world(vec3(1.0f));
    world.add_real(scene::make_rectangle(vec2(3.0f)), vec3(0.5f), 0.5f, 0.0f);
    world.add(scene::make_box({0.5f, 0.1f, 0.5f}), unlit({0.2f, 0.4f, 0.8f}),
              {.position = {0.0f, 3.0f, 0.0f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    const Rendered rendered = rig.render(looking_down(16));
    const auto& seen = rendered.light[8 * 16 + 8];  // straight down: the box is overhead
    expect_near(seen.added, 0.5f * vec3(0.2f, 0.4f, 0.8f), 0.03f, "mirrored box");
    EXPECT_EQ(seen.radiance, vec3(0.0f));
    EXPECT_EQ(seen.coverage, 0.0f);
    EXPECT_EQ(rendered.light[0].added, vec3(0.0f)) << "the mirrored ray passes the box";
}

// The camera sees one colour everywhere before it: a mirror shows that colour, not the environment.
TEST_F(LightingTest, MirrorShowsTheCamerasPicture) {
    TestScene world(vec3(0.1f));
    world.add(scene::make_rectangle(vec2(1.0f)), metal(vec3(1.0f), 0.0f),
              {glm::angleAxis(0.5f * pi, vec3(1.0f, 0.0f, 0.0f)), {0.0f, 0.0f, -1.0f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);

    gpu::Uploader uploader(device());
    const std::array<std::uint8_t, 4> texel = {0, 255, 0, 255};
    const gpu::Image picture = uploader.image(
        "test picture", {{1, 1}, vk::Format::eR8G8B8A8Unorm, 1, vk::ImageUsageFlagBits::eSampled},
        gpu::range_bytes(texel));
    uploader.flush();
    shared::RoomParams room{};
    room.camera_from_stage =
        to_matrix(Pose{glm::angleAxis(pi, vec3(0.0f, 1.0f, 0.0f)), vec3(0.0f)});  // looks along +z
    room.stage_from_world = mat4(1.0f);
    room.focal = vec2(100.0f);
    room.principal = vec2(100.0f);
    room.picture_size = vec2(200.0f);
    room.picture = rig.textures().add(picture.view(), {});
    room.max_angle = radians(80.0f);
    room.far_distance = 5.0f;
    room.exposure = 0.5f;
    gpu::Buffer params(device(), "test room", sizeof room, gpu::Residence::Upload);
    params.write(gpu::bytes_of(room));

    Shot shot;
    // The mirror stands upright one metre ahead and mirrors what is behind the eye.
    shot.views = {square_view(5.0f, 4, look_at({0.0f, 0.5f, 0.0f}, {0.0f, 0.5f, -1.0f}))};
    shot.room = params.address();
    const Rendered rendered = rig.render(shot);
    ASSERT_EQ(rendered.surfaces[0].kind, shared::SURFACE_VIRTUAL);
    expect_near(rendered.light[0].radiance, {0.0f, 0.5f, 0.0f}, 0.03f, "picture");
    room.picture = shared::NO_PICTURE;
    params.write(gpu::bytes_of(room));
    expect_near(rig.render(shot).light[0].radiance, vec3(0.1f), 0.03f, "environment");
}

TEST_F(LightingTest, SubSamplesAreAveraged) {
    TestScene world;
    world.add(scene::make_rectangle({1.0f, 3.0f}), unlit(vec3(1.0f)), {.position = {-1.0f, 0.0f, 0.0f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot = looking_down(5);  // the edge runs through the middle column
    shot.settings.reference_samples = 64;
    const Rendered rendered = rig.render(shot);
    EXPECT_EQ(rendered.rays[shared::COUNT_PRIMARY], 64u * 25u);
    EXPECT_NEAR(rendered.light[10].coverage, 1.0f, 1e-4f);
    EXPECT_NEAR(rendered.light[12].coverage, 0.5f, 0.02f);
    EXPECT_NEAR(rendered.light[12].radiance.x, 0.5f, 0.02f);
    EXPECT_NEAR(rendered.light[14].coverage, 0.0f, 1e-4f);
}

}  // namespace
}  // namespace foveray::render
