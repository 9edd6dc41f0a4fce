// Ambient occlusion, refraction, reflections of reflections, against closed forms.
#include <cmath>

#include "app/offscreen/offscreen.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/light_rig.h"
#include "tests/render/light/test_scene.h"

namespace foveray::render {
namespace {

using SecondRayTest = fakes::GpuTest;
using glm::dvec3;

scene::Material glass(vec3 color, float ior, bool solid) {
    scene::Material material = matte(color);
    material.roughness = 0.0f;
    material.transmission = 1.0f;
    material.ior = ior;
    material.solid = solid;
    return material;
}

float fresnel(float ior, float cosine) {
    const float r = (ior - 1.0f) / (ior + 1.0f), f0 = r * r;
    return f0 + (1.0f - f0) * std::pow(1.0f - cosine, 5.0f);
}

// A high wall beside a floor hides the part of the sky that lies behind it within reach.
TEST_F(SecondRayTest, AmbientOcclusionIsWhatAWallHides) {
    TestScene world(vec3(1.0f));
    world.add(scene::make_rectangle(vec2(3.0f)), matte(vec3(1.0f)));
    world.add(scene::make_box({0.01f, 3.0f, 3.0f}), unlit(vec3(0.0f)), {.position = {0.51f, 0.0f, 0.0f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    shot.views = {square_view(10.0f, 12, look_at({0.1f, 1.0f, 0.0f}, {0.3f, 0.0f, 0.0f}))};
    shot.settings.ambient_occlusion_samples = 256;
    shot.settings.ambient_occlusion_m = 0.6f;
    const Rendered occluded = rig.render(shot);
    shot.settings.ambient_occlusion_samples = 0;
    const Rendered open = rig.render(shot);
    EXPECT_EQ(open.rays[shared::COUNT_OCCLUSION], 0u);
    int darker = 0;
    for (std::size_t i = 0; i < open.light.size(); ++i) {
        const vec3 p = occluded.surfaces[i].position;
        if (std::abs(p.y) > 1e-4f || p.x > 0.49f) continue;
        constexpr int steps = 300;
        double seen = 0.0;
        for (int a = 0; a < steps; ++a) {
            for (int b = 0; b < steps; ++b) {
                const double sine = std::sqrt((a + 0.5) / steps),
                             angle = 2.0 * double{pi} * (b + 0.5) / steps;
                const double towards = sine * std::cos(angle);
                seen += !(towards > 0.0 && (0.5 - double{p.x}) / towards < 0.6);
            }
        }
        seen /= steps * steps;
        // The mirrored part, a few per cent, is not occluded.
        const double mirrored = open.light[i].radiance.x > 0.0f ? 0.05 : 0.0;
        EXPECT_NEAR(occluded.light[i].radiance.x / open.light[i].radiance.x, seen, 0.02 + mirrored) << p.x;
        darker += seen < 0.9;
    }
    EXPECT_GT(darker, 50);
}

// Over a floor that is red on one side and blue on the other lies a slab of glass: the edge is seen
// displaced, by Snell's law, through what the glass absorbs on the way.
TEST_F(SecondRayTest, GlassBendsLightAndTakesItsColour) {
    const float thickness = 0.3f, ior = 1.5f;
    const vec3 left(1.0f, 0.2f, 0.0f), right(0.0f, 0.2f, 1.0f), absorbed(0.5f, 0.8f, 0.6f);
    TestScene world;
    world.add(scene::make_rectangle({1.0f, 3.0f}), unlit(left), {.position = {-1.0f, 0.0f, 0.0f}});
    world.add(scene::make_rectangle({1.0f, 3.0f}), unlit(right), {.position = {1.0f, 0.0f, 0.0f}});
    scene::Material material = glass(vec3(0.9f, 1.0f, 0.8f), ior, true);
    material.attenuation_color = absorbed;
    material.attenuation_distance = 0.2f;
    world.add(scene::make_box({2.0f, 0.5f * thickness, 2.0f}), material, {.position = {0.0f, 0.4f, 0.0f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    shot.views = {square_view(8.0f, 24, look_at({-0.9f, 1.3f, 0.0f}, {0.0f, 0.0f, 0.0f}))};
    shot.settings.ambient_occlusion_samples = 0;
    shot.settings.second_ray_depth = 2;
    const Rendered rendered = rig.render(shot);
    int red = 0, blue = 0;
    for (std::size_t i = 0; i < rendered.light.size(); ++i) {
        const vec3 entry = rendered.surfaces[i].position, eye = shot.views[0].stage_from_eye.position;
        const vec3 d = glm::normalize(entry - eye), inside = glm::refract(d, vec3(0, 1, 0), 1.0f / ior);
        const vec3 exit = entry + thickness / -inside.y * inside;
        const float x = exit.x + exit.y / -d.y * d.x;
        if (std::abs(x) < 2e-3f) continue;
        const float way = thickness / -inside.y;
        const vec3 expected = (1.0f - fresnel(ior, -d.y)) * vec3(0.9f, 1.0f, 0.8f) *
                              glm::pow(absorbed, vec3(way / 0.2f)) * (x < 0.0f ? left : right);
        const vec3 found = rendered.light[i].radiance;
        EXPECT_LT(glm::length(found - expected), 0.01f)
            << x << ": " << found.x << ' ' << found.y << ' ' << found.z;
        EXPECT_EQ(rendered.light[i].coverage, 1.0f);
        ++(x < 0.0f ? red : blue);
    }
    EXPECT_GT(red, 100);
    EXPECT_GT(blue, 100);
}

// At a glancing angle light cannot leave the glass: it is thrown back inside, out of the slab's other side.
TEST_F(SecondRayTest, LightThatCannotLeaveIsReflectedInside) {
    TestScene world;
    // A cube of high index, looked into through its front: its side walls act as mirrors.
    world.add(scene::make_box(vec3(0.5f)), glass(vec3(1.0f), 2.0f, true), {.position = {0.0f, 0.0f, -0.5f}});
    world.add(scene::make_box({3.0f, 3.0f, 0.01f}), unlit({0.0f, 1.0f, 0.0f}),
              {.position = {0.0f, 0.0f, -2.0f}});
    world.add(scene::make_box({0.01f, 3.0f, 3.0f}), unlit({1.0f, 0.0f, 0.0f}),
              {.position = {1.0f, 0.0f, 0.0f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    // Meets the front face near its right edge, going right: inside it meets the right wall beyond the limit.
    shot.views = {square_view(0.5f, 4, look_at({0.2f, 0.0f, 0.4f}, {0.45f, 0.0f, 0.0f}))};
    shot.settings.ambient_occlusion_samples = 0;
    shot.settings.reflections = false;  // the front face mirrors the red wall
    const Rendered rendered = rig.render(shot);
    for (const auto& light : rendered.light) {
        EXPECT_LT(light.radiance.x, 0.05f) << "the red wall beside the cube";
        EXPECT_GT(light.radiance.y, 0.5f) << "the green wall behind it";
    }
}

TEST_F(SecondRayTest, ThinSheetsTintWhatTheViewerSees) {
    const vec3 tint(0.9f, 0.5f, 0.2f), floor(0.4f, 0.6f, 0.8f);
    TestScene world;
    world.add(scene::make_rectangle({1.5f, 3.0f}), unlit(floor), {.position = {-1.5f, 0.0f, 0.0f}});
    world.add_real(scene::make_rectangle({1.5f, 3.0f}), vec3(0.5f), 0.0f, 0.0f,
                   {.position = {1.5f, 0.0f, 0.0f}});
    scene::Material sheet = glass(tint, 1.5f, false);
    sheet.double_sided = true;
    world.add(scene::make_rectangle(vec2(3.0f)), sheet, {.position = {0.0f, 0.5f, 0.0f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    shot.views = {square_view(10.0f, 4, look_at({0.0f, 2.0f, 0.0f}, vec3(0.0f)))};
    shot.settings.ambient_occlusion_samples = 0;
    const Rendered rendered = rig.render(shot);
    const auto& over_virtual = rendered.light[4];
    const auto& over_real = rendered.light[7];
    EXPECT_LT(glm::length(over_virtual.radiance - 0.96f * tint * floor), 0.01f);
    EXPECT_EQ(over_virtual.coverage, 1.0f);
    EXPECT_LT(glm::length(over_real.radiance), 0.01f);
    EXPECT_NEAR(over_real.coverage, 0.04f, 0.01f);
    EXPECT_LT(glm::length(over_real.transmittance - tint), 0.01f);
}

// Without a real surface in the scene too: the compositor shows what stands behind, here the environment,
// through it.
TEST_F(SecondRayTest, ThinSheetsTintThePictureBehind) {
    const vec3 tint(0.9f, 0.5f, 0.2f), behind(0.5f, 0.6f, 0.7f);
    TestScene world(behind);
    scene::Material sheet = glass(tint, 1.5f, false);
    sheet.double_sided = true;
    world.add(scene::make_rectangle({1.0f, 3.0f}), sheet,
              {glm::angleAxis(0.5f * pi, vec3(1.0f, 0.0f, 0.0f)), {-1.0f, 0.0f, -1.0f}});
    const scene::Scene scene = world.build();
    app::Offscreen offscreen(device(), scene);
    app::Shot shot;
    shot.views = {square_view(10.0f, 32)};
    shot.acuity = {.a = 60.0f, .b = 1.0f, .cap_ppd = 4.0f, .outer_degrees = 30.0f};
    shot.settings.tone_mapping = "none";
    for (const bool every_pixel : {true, false}) {
        shot.every_pixel = every_pixel;
        offscreen.draw(shot);
        const Image picture = offscreen.picture(0);
        for (int c = 0; c < 3; ++c) {
            const auto shown = [&](std::uint32_t x) {
                return linear_from_srgb(static_cast<float>(picture.at(x, 16)[c]) / 255.0f);
            };
            EXPECT_NEAR(shown(28), behind[c], 0.01f) << every_pixel << " beside the sheet";
            // Of the sheet's front a twentieth at most is mirrored.
            EXPECT_NEAR(shown(4), behind[c] * (0.045f + 0.96f * tint[c]), 0.02f * behind[c]) << every_pixel;
        }
    }
}

// Between two mirrors each ray goes on as often as it may.
TEST_F(SecondRayTest, MirrorsInMirrorsGoAsDeepAsAsked) {
    TestScene world(vec3(0.25f));
    world.add(scene::make_rectangle(vec2(3.0f)), metal(vec3(0.9f), 0.0f));
    world.add(scene::make_box({3.0f, 0.01f, 3.0f}), metal(vec3(0.9f), 0.0f),
              {.position = {0.0f, 1.0f, 0.0f}});
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    shot.views = {square_view(2.0f, 3, look_at({0.0f, 0.5f, 0.0f}, {0.3f, 0.0f, 0.0f}))};
    float last = 1.0f;
    for (const int depth : {1, 2, 4}) {
        shot.settings.second_ray_depth = depth;
        const Rendered rendered = rig.render(shot);
        EXPECT_EQ(rendered.rays[shared::COUNT_REFLECTION],
                  static_cast<std::uint64_t>(depth) * rendered.light.size());
        // Each mirror takes a tenth, and the last one shows the environment.
        const float expected = 0.25f * std::pow(0.9f, static_cast<float>(depth + 1));
        EXPECT_NEAR(rendered.light[4].radiance.x, expected, 0.01f) << depth;
        EXPECT_LT(rendered.light[4].radiance.x, last);
        last = rendered.light[4].radiance.x;
    }
}

}  // namespace
}  // namespace foveray::render
