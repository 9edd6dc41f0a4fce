#include "render/resolve.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "base/image.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/light_rig.h"
#include "tests/render/light/test_scene.h"

namespace foveray::render {
namespace {

using ResolveTest = fakes::GpuTest;

/// Smooth, different in every channel, without symmetry.
vec3 pattern(vec3 d) {
    return 0.5f + 0.4f * vec3(std::sin(7.0f * d.x + 2.0f * d.y), std::cos(6.0f * d.y - 3.0f * d.z),
                              std::sin(5.0f * d.x * d.y + 4.0f * d.z));
}

scene::Scene closed_room() {
    TestScene world;
    scene::Material white = unlit(vec3(1.0f));
    white.double_sided = true;
    world.add(scene::make_box(vec3(5.0f)), white);
    return world.build();
}

Shot polar_shot(float half_angle_degrees, std::uint32_t pixels) {
    Shot shot;
    shot.every_pixel = false;
    shot.acuity = {.a = 60.0f, .b = 1.0f, .cap_ppd = 8.0f, .outer_degrees = 90.0f};
    shot.views = {square_view(half_angle_degrees, pixels)};
    shot.paint = [](vec3 direction, float distance) {
        const vec3 p = pattern(direction);
        return shared::LightSample{p, p.x, 1.0f - 0.5f * p, distance, 0.25f * p, 1.0f};
    };
    return shot;
}

float worst_error(const Picture& picture, const View& view) {
    float worst = 0.0f;
    for (std::uint32_t y = 0; y < view.size.y; ++y) {
        for (std::uint32_t x = 0; x < view.size.x; ++x) {
            const vec3 e = glm::abs(picture.at(x, y).radiance - pattern(direction_of(view, x, y)));
            worst = std::max({worst, e.x, e.y, e.z});
        }
    }
    return worst;
}

TEST_F(ResolveTest, RebuildsASmoothPicture) {
    const scene::Scene scene = closed_room();
    LightRig rig(device(), scene);
    // Pixels coarser and finer than samples; gaze at a pixel's centre, off-centre, outside of the view.
    for (const std::uint32_t pixels : {33u, 160u}) {
        for (const vec3 gaze :
             {vec3(0.0f, 0.0f, -1.0f), vec3(0.3f, -0.2f, -1.0f), vec3(-0.95f, 0.0f, -1.0f)}) {
            Shot shot = polar_shot(40.0f, pixels);
            shot.fovea.direction = glm::normalize(gaze);
            for (const auto& [filter, tolerance] :
                 {std::pair("bicubic", 0.01f), std::pair("bilinear", 0.03f)}) {
                shot.settings.resolve_filter = filter;
                const Rendered rendered = rig.render(shot);
                EXPECT_LT(worst_error(rendered.views[0], shot.views[0]), tolerance)
                    << filter << ' ' << pixels << " gaze " << gaze.x;
            }
        }
    }
}

// Nor does the farthest reach of the kernel, where it is below zero, leave black beside what is far brighter
// than white.
TEST_F(ResolveTest, HighlightsHaveNoDarkRings) {
    const scene::Scene scene = closed_room();
    LightRig rig(device(), scene);
    for (const std::uint32_t pixels : {33u, 160u}) {
        Shot shot = polar_shot(40.0f, pixels);
        shot.fovea.direction = glm::normalize(vec3(0.3f, -0.2f, -1.0f));
        shot.paint = [](vec3 direction, float distance) {
            const bool lamp = glm::distance(direction, glm::normalize(vec3(-0.2f, 0.2f, -1.0f))) < 0.05f;
            return shared::LightSample{
                vec3(lamp ? 200.0f : 0.3f), 1.0f, vec3(0.0f), distance, vec3(0.0f), 1.0f};
        };
        const Picture picture = rig.render(shot).views[0];
        int bright = 0;
        for (const Pixel& pixel : picture.pixels) {
            EXPECT_GE(pixel.radiance.x, 0.299f);
            bright += pixel.radiance.x > 1.0f;
        }
        EXPECT_GT(bright, 1);
    }
}

TEST_F(ResolveTest, FiltersAllLayersAlikeAndWeighsTheRealByWhatIsSeen) {
    const scene::Scene scene = closed_room();
    LightRig rig(device(), scene);
    const Shot shot = polar_shot(20.0f, 40);
    const Rendered rendered = rig.render(shot);
    for (std::uint32_t i = 0; i < 40; ++i) {
        const Pixel& pixel = rendered.views[0].at(i, 13);
        const vec3 p = pattern(direction_of(shot.views[0], i, 13));
        EXPECT_TRUE(pixel.visible);
        EXPECT_NEAR(pixel.coverage, p.x, 0.01f);
        EXPECT_NEAR(pixel.transmittance.y, 1.0f - 0.5f * p.y, 0.02f);
        EXPECT_NEAR(pixel.added.z, 0.25f * p.z, 0.01f);
    }
}

// Left half covered and dark beneath it: the pixels on the edge must not darken what is seen beside it.
TEST_F(ResolveTest, WhatIsHiddenDoesNotShadeWhatIsSeen) {
    const scene::Scene scene = closed_room();
    LightRig rig(device(), scene);
    Shot shot = polar_shot(20.0f, 64);
    shot.paint = [](vec3 d, float distance) {
        const bool covered = d.x < 0.0f;
        return shared::LightSample{vec3(0.0f), covered ? 1.0f : 0.0f,       vec3(covered ? 0.0f : 0.5f),
                                   distance,   vec3(covered ? 9.0f : 0.0f), 1.0f};
    };
    const Picture picture = rig.render(shot).views[0];
    for (const Pixel& pixel : picture.pixels) {
        if (pixel.coverage > 0.99f) continue;
        EXPECT_NEAR(pixel.transmittance.x, 0.5f, 0.01f);
        EXPECT_NEAR(pixel.added.x, 0.0f, 0.01f);
    }
}

TEST_F(ResolveTest, CulledSamplesAreLeftOut) {
    const scene::Scene scene = closed_room();
    LightRig rig(device(), scene);
    Shot shot = polar_shot(20.0f, 64);
    // A third of the samples, scattered.
    shot.paint = [](vec3 d, float distance) {
        const bool culled = std::fmod(std::abs(d.x * 9173.0f + d.y * 5167.0f), 1.0f) < 0.33f;
        return shared::LightSample{vec3(culled ? 100.0f : 0.7f), 1.0f, vec3(1.0f), distance, vec3(0.0f),
                                   culled ? 0.0f : 1.0f};
    };
    shot.settings.resolve_filter = "bilinear";
    int checked = 0;
    const Picture picture = rig.render(shot).views[0];
    for (const Pixel& pixel : picture.pixels) {
        if (pixel.coverage == 0.0f) continue;  // all around it was culled
        EXPECT_NEAR(pixel.radiance.x, 0.7f, 0.01f);
        ++checked;
    }
    EXPECT_GT(checked, 60 * 64);
}

TEST_F(ResolveTest, DepthIsTheNearestSamplesAndNeverBlended) {
    const scene::Scene scene = closed_room();
    LightRig rig(device(), scene);
    Shot shot = polar_shot(30.0f, 64);
    // A step: 1 m on the left, nothing on the right.
    shot.paint = [](vec3 d, float) {
        return shared::LightSample{vec3(1.0f), 1.0f, vec3(1.0f), d.x < 0.0f ? 1.0f : -1.0f, vec3(0.0f), 1.0f};
    };
    const Picture picture = rig.render(shot).views[0];
    for (std::uint32_t y = 0; y < 64; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            const float depth = picture.at(x, y).depth, cosine = -direction_of(shot.views[0], x, y).z;
            EXPECT_TRUE(std::isinf(depth) || std::abs(depth - cosine) < 1e-3f) << depth;
            EXPECT_TRUE((x >= 30 && x <= 33) || std::isinf(depth) == (x > 33)) << x;
        }
    }
}

TEST_F(ResolveTest, PixelSamplesAreCopied) {
    TestScene world;
    world.add(scene::make_rectangle(vec2(0.3f, 3.0f)), unlit({0.25f, 0.5f, 0.75f}));
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    Shot shot;
    shot.views = {square_view(25.0f, 9, look_at({0.0f, 2.0f, 0.0f}, vec3(0.0f)))};
    const Rendered rendered = rig.render(shot);
    for (std::size_t i = 0; i < rendered.light.size(); ++i) {
        const vec3 error = rendered.views[0].pixels[i].radiance - rendered.light[i].radiance;
        EXPECT_LT(glm::length(error), 1e-3f);  // of a half
        EXPECT_EQ(rendered.views[0].pixels[i].coverage, rendered.light[i].coverage);
    }
    EXPECT_NEAR(rendered.views[0].center().depth, 2.0f, 1e-5f);
    EXPECT_TRUE(std::isinf(rendered.views[0].at(0, 4).depth));
}

scene::Scene still_life() {
    TestScene world(vec3(0.3f));
    world.add(scene::make_sphere(0.4f, 24), metal({0.9f, 0.6f, 0.3f}, 0.2f),
              {.position = {0.0f, 0.0f, -1.5f}});
    world.add(scene::make_box(vec3(0.2f)), matte({0.8f, 0.2f, 0.2f}), {.position = {0.7f, -0.2f, -1.8f}});
    world.add(scene::make_box({0.2f, 0.3f, 0.01f}), unlit({0.1f, 0.3f, 0.9f}, 0.5f),
              {.position = {-0.5f, -0.1f, -1.0f}});
    world.add(scene::AreaLight{"lamp", scene::AreaLightShape::Rectangle, vec3(0.3f), vec3(12.0f)},
              look_at({0.7f, 1.5f, -1.0f}, {0.0f, 0.0f, -1.5f}));
    world.add_real(scene::make_rectangle(vec2(3.0f)), vec3(0.5f), 0.1f, 0.1f,
                   {.position = {0.0f, -0.4f, 0.0f}});
    return world.build();
}

/// Over a grey room, for the eye.
void write_picture(const std::string& name, const Picture& picture) {
    const char* folder = std::getenv("FOVERAY_TEST_PICTURES");
    if (!folder) return;
    Image image(picture.size.x, picture.size.y, 3);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const Pixel& p = picture.at(x, y);
            const vec3 color = p.radiance + (1.0f - p.coverage) * (0.4f * p.transmittance + p.added);
            for (int c = 0; c < 3; ++c) {
                image.at(x, y)[c] = static_cast<std::uint8_t>(
                    255.0f * srgb_from_linear(std::clamp(color[c], 0.0f, 1.0f)) + 0.5f);
            }
        }
    }
    write_png(std::filesystem::path(folder) / (name + ".png"), image);
}

TEST_F(ResolveTest, DebugViewsShowWhatTheyName) {
    const scene::Scene scene = still_life();
    LightRig rig(device(), scene);
    Shot shot = polar_shot(40.0f, 256);
    shot.acuity = {.a = 100.0f, .b = 1.0f, .cap_ppd = 20.0f, .outer_degrees = 90.0f};
    shot.paint = nullptr;
    shot.settings.shadow_samples = 16;
    shot.fovea.direction = glm::normalize(vec3(0.1f, 0.1f, -1.0f));
    std::map<std::string, Picture> pictures;
    for (const char* name : {"none", "tiles", "samples", "normal", "albedo", "shadow", "depth"}) {
        shot.settings.debug_view = name;
        pictures[name] = rig.render(shot).views[0];
        write_picture(name, pictures[name]);
    }
    // In empty space beside the gaze, at 10 and 20 degrees to the right of it, tiles differ.
    const auto at = [&](const char* name, float right_degrees, float up_degrees) {
        const float angle = std::atan(0.1f);
        const vec2 tangent(std::tan(angle + radians(right_degrees)), std::tan(angle + radians(up_degrees)));
        const vec2 uv = uv_of(shot.views[0].fov, vec3(tangent, -1.0f));
        return pictures[name].at(static_cast<std::uint32_t>(256.0f * uv.x),
                                 static_cast<std::uint32_t>(256.0f * uv.y));
    };
    EXPECT_GT(glm::length(at("tiles", 18.0f, 2.0f).radiance - at("tiles", 25.0f, 8.0f).radiance), 0.1f);
    EXPECT_EQ(at("none", 18.0f, 2.0f).coverage, 0.0f);
    const Pixel sphere = at("normal", -5.7f, -5.7f);  // straight ahead: faces the eye
    EXPECT_NEAR(sphere.radiance.z, 1.0f, 0.02f);
    EXPECT_NEAR(at("albedo", -5.7f, -5.7f).radiance.x, 0.9f, 0.02f);
    EXPECT_NEAR(at("depth", -5.7f, -5.7f).radiance.x, 1.0f / 2.1f, 0.02f);
}

TEST_F(ResolveTest, SameFrameTwiceIsTheSameToTheBit) {
    const scene::Scene scene = still_life();
    const auto bits = [&] {
        LightRig rig(device(), scene);
        Shot shot = polar_shot(40.0f, 64);
        shot.paint = nullptr;
        std::vector<float> values;
        const Picture picture = rig.render(shot).views[0];
        for (const Pixel& p : picture.pixels) {
            for (const float v : {p.radiance.x, p.radiance.y, p.radiance.z, p.coverage, p.transmittance.x,
                                  p.added.x, p.depth})
                values.push_back(v);
        }
        return values;
    };
    EXPECT_EQ(bits(), bits());
}

}  // namespace
}  // namespace foveray::render
