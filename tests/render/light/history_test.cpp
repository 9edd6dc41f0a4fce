#include "render/history.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "base/image.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/light_rig.h"
#include "tests/render/light/test_scene.h"

namespace foveray::render {
namespace {

using HistoryTest = fakes::GpuTest;

constexpr Nanoseconds period = nanoseconds_per_second / 90;

/// Edges of all directions in a soft shadow's grain.
scene::Scene fences() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    TestScene world(vec3(0.1f));
    world.add(scene::make_box({6.0f, 0.1f, 6.0f}), matte(vec3(0.7f)), {.position = {0.0f, -1.3f, 0.0f}});
    for (int i = 0; i < 120; ++i) {
        const float angle = 2.0f * pi * unit(random), distance = 1.5f + 2.0f * unit(random);
        const vec3 size = 0.05f + 0.25f * vec3(unit(random), unit(random), unit(random));
        const vec3 axis = glm::normalize(vec3(unit(random), unit(random), unit(random)) - 0.5f);
        world.add(scene::make_box(size), matte(vec3(unit(random), unit(random), unit(random))),
                  {glm::angleAxis(6.0f * unit(random), axis),
                   {distance * std::cos(angle), 2.0f * unit(random) - 1.2f, distance * std::sin(angle)}});
    }
    world.add(scene::AreaLight{"lamp", scene::AreaLightShape::Rectangle, vec3(0.6f), vec3(8.0f)},
              look_at({0.5f, 2.5f, 0.5f}, {0.0f, 0.0f, 0.01f}));
    return world.build();
}

Pose turned(float yaw_degrees) {
    return {glm::angleAxis(radians(yaw_degrees), vec3(0.0f, 1.0f, 0.0f)), vec3(0.0f)};
}

/// Shows 15 to 65 degrees beside the gaze, which turns with the head.
Shot side_shot(float yaw_degrees, std::uint32_t pixels = 96) {
    Shot shot;
    const Pose pose = turned(yaw_degrees);
    shot.views = {square_view(25.0f, pixels, pose)};
    shot.acuity = {.a = 60.0f, .b = 3.0f, .cap_ppd = 20.0f, .outer_degrees = 85.0f};
    shot.every_pixel = false;
    shot.fovea.direction =
        transform_direction(pose, direction_at(square_view(40.0f, 1).fov, vec2(0.0f, 0.5f)));
    shot.settings.shadow_samples = 1;
    shot.history = true;
    shot.read_samples = false;
    return shot;
}

/// Lets the rig forget its frames: a pixel grid has no history.
void start_over(LightRig& rig) {
    Shot shot;
    shot.views = {square_view(1.0f, 1)};
    rig.render(shot);
}

/// What the display shows, 0 to 1.
FloatImage shown(FloatImage radiance) {
    for (float& value : radiance.pixels) value = srgb_from_linear(std::clamp(value, 0.0f, 1.0f));
    return radiance;
}
FloatImage shown(const Picture& picture) { return shown(radiance_of(picture)); }

FloatImage low_pass(const FloatImage& image, float sigma) {
    const int reach = static_cast<int>(std::ceil(2.5f * sigma));
    const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
    FloatImage result(image.width, image.height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float sum[3] = {}, total = 0.0f;
            for (int j = std::max(y - reach, 0); j <= std::min(y + reach, height - 1); ++j) {
                for (int i = std::max(x - reach, 0); i <= std::min(x + reach, width - 1); ++i) {
                    const auto square = static_cast<float>((i - x) * (i - x) + (j - y) * (j - y));
                    const float weight = std::exp(-0.5f * square / (sigma * sigma));
                    for (int c = 0; c < 3; ++c)
                        sum[c] += weight *
                                  image.at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j))[c];
                    total += weight;
                }
            }
            for (int c = 0; c < 3; ++c)
                result.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))[c] = sum[c] / total;
        }
    }
    return result;
}

/// How much two pictures differ in what both show of the world: root of the mean square.
double change(const FloatImage& before, const View& view_before, const FloatImage& now,
              const View& view_now) {
    const Pose before_from_now = inverse(view_before.stage_from_eye) * view_now.stage_from_eye;
    double sum = 0.0;
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < now.height; ++y) {
        for (std::uint32_t x = 0; x < now.width; ++x) {
            const vec2 uv = (vec2(x, y) + 0.5f) / vec2(view_now.size);
            const vec3 d = transform_direction(before_from_now, direction_at(view_now.fov, uv));
            const vec2 p = uv_of(view_before.fov, d) * vec2(view_before.size) - 0.5f;
            if (p.x < 0.0f || p.y < 0.0f || p.x >= static_cast<float>(before.width - 1) ||
                p.y >= static_cast<float>(before.height - 1))
                continue;
            const auto i = static_cast<std::uint32_t>(p.x), j = static_cast<std::uint32_t>(p.y);
            const vec2 f = glm::fract(p);
            for (int c = 0; c < 3; ++c) {
                const float then =
                    glm::mix(glm::mix(before.at(i, j)[c], before.at(i + 1, j)[c], f.x),
                             glm::mix(before.at(i, j + 1)[c], before.at(i + 1, j + 1)[c], f.x), f.y);
                const double difference = double{now.at(x, y)[c]} - double{then};
                sum += difference * difference;
                ++count;
            }
        }
    }
    return std::sqrt(sum / static_cast<double>(count));
}

void write_picture(const std::string& name, const FloatImage& image) {
    const char* folder = std::getenv("FOVERAY_TEST_PICTURES");
    if (!folder) return;
    Image bytes(image.width, image.height, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        bytes.pixels[i] = static_cast<std::uint8_t>(255.0f * image.pixels[i] + 0.5f);
    write_png(std::filesystem::path(folder) / (name + ".png"), bytes);
}

// Issue 4, part 7. The head turns by 4.5 and by 45 degrees a second. Full resolution is low-passed to about
// the spacing of the samples there, a pixel and more.
TEST_F(HistoryTest, PeripheryIsAboutAsCalmAsAtFullResolution) {
    const scene::Scene scene = fences();
    LightRig rig(device(), scene);
    for (const float degrees_a_frame : {0.05f, 0.5f}) {
        constexpr int frames = 18, settling = 10;
        const auto shot_at = [&](int i) {
            Shot shot = side_shot(degrees_a_frame * static_cast<float>(i));
            shot.time = i * period;
            return shot;
        };
        FloatImage last;
        const auto restlessness = [&](const std::string& name, auto&& adjust) {
            start_over(rig);
            double sum = 0.0;
            View view_before;
            for (int i = 0; i < frames; ++i) {
                Shot shot = shot_at(i);
                adjust(shot);
                if (shot.every_pixel && i < settling - 1) continue;
                const FloatImage radiance = radiance_of(rig.render(shot).views[0]);
                FloatImage now = shown(shot.every_pixel ? low_pass(radiance, 1.0f) : radiance);
                if (i >= settling) sum += change(last, view_before, now, shot.views[0]);
                last = std::move(now);
                view_before = shot.views[0];
            }
            write_picture(name, last);
            return sum / (frames - settling);
        };
        Shot exact = shot_at(frames - 1);
        exact.every_pixel = true;
        exact.settings.reference_samples = 32;
        const FloatImage truth = shown(low_pass(radiance_of(rig.render(exact).views[0]), 1.0f));
        const auto error = [&] { return change(truth, exact.views[0], last, exact.views[0]); };

        const double full = restlessness("full", [](Shot& shot) { shot.every_pixel = true; });
        const double without = restlessness("without", [](Shot& shot) {
            shot.settings.history_temporal = shot.settings.history_spatial = false;
        });
        const double error_without = error();
        const double with = restlessness("with", [](Shot&) {});
        const double error_with = error();
        std::cout << degrees_a_frame << " degrees a frame: changes by " << full << " at full resolution, by "
                  << without << " without history, by " << with << " with; error " << error_without
                  << " without, " << error_with << " with\n";
        EXPECT_LT(with, 1.4 * full);
        EXPECT_GT(without, 2.0 * full);
        // Not by blurring.
        EXPECT_LT(error_with, 0.75 * error_without);
    }
}

/// Noise of mean 1, mostly 0, so that no neighbourhood tells much about the mean. In cells, so that it does
/// not depend on rounding.
float grain(vec3 direction) {
    const vec3 cell = glm::floor(150.0f * direction + 0.37f);
    const float hash = std::sin(cell.x * 12.91f + cell.y * 78.17f + cell.z * 35.71f) * 43758.5f;
    return hash - std::floor(hash) < 0.125f ? 8.0f : 0.0f;
}

double mean_radiance(const Picture& picture) {
    double sum = 0.0;
    for (const Pixel& pixel : picture.pixels) sum += pixel.radiance.x;
    return sum / static_cast<double>(picture.pixels.size());
}

scene::Scene closed_room(const scene::Material& material) {
    TestScene world;
    scene::Material inside = material;
    inside.double_sided = true;
    world.add(scene::make_box(vec3(5.0f)), inside);
    return world.build();
}

TEST_F(HistoryTest, StepInTheLightReaches90PercentWithin100Milliseconds) {
    const scene::Scene scene = closed_room(unlit(vec3(1.0f)));
    LightRig rig(device(), scene);
    for (const int rate : {20, 60, 90, 200}) {
        start_over(rig);
        Shot shot = side_shot(0.0f, 32);
        shot.read_samples = true;  // the painter wants them
        const Nanoseconds dt = nanoseconds_per_second / rate;
        const auto frame = [&](Nanoseconds time, float light) {
            shot.time = time;
            shot.paint = [&](vec3 direction, float distance) {
                return shared::LightSample{
                    vec3(light * grain(direction)), 1.0f, vec3(1.0f), distance, vec3(0.0f), 1.0f};
            };
            return mean_radiance(rig.render(shot).views[0]);
        };
        const double before = frame(0, 0.01f);
        double now = frame(dt, 0.1f);
        // It settles at all, and over the same time at any rate.
        const double all = before * 10.0;
        const double first = (now - before) / (all - before);
        const double expected = 1.0 - std::pow(0.1, to_seconds(dt) / to_seconds(HistoryStage::settling_time));
        EXPECT_GE(first, expected - 0.02) << rate;
        EXPECT_TRUE(rate <= 60 || first < 0.75) << rate;
        for (Nanoseconds t = 2 * dt; t <= dt + 100 * nanoseconds_per_millisecond; t += dt)
            now = frame(t, 0.1f);
        EXPECT_GE((now - before) / (all - before), 0.9) << rate;
        EXPECT_LE((now - before) / (all - before), 1.01) << rate;
    }
}

std::vector<float> bits(const Picture& picture) {
    std::vector<float> values;
    for (const Pixel& p : picture.pixels)
        for (const float v : {p.radiance.x, p.radiance.y, p.radiance.z, p.coverage, p.depth})
            values.push_back(v);
    return values;
}

TEST_F(HistoryTest, StillSceneIsStillAndAsIfThereHadBeenNoOther) {
    const scene::Scene scene = fences();
    LightRig rig(device(), scene);
    Nanoseconds time = 0;
    const auto frame = [&](float yaw_degrees) {
        Shot shot = side_shot(yaw_degrees, 48);
        shot.time = time += period;
        return bits(rig.render(shot).views[0]);
    };
    for (int i = 0; i < 4; ++i) frame(2.0f * static_cast<float>(i));
    for (int i = 0; i < 100; ++i) frame(3.0f);
    const auto settled = frame(3.0f);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(frame(3.0f), settled) << i;
    start_over(rig);
    Shot alone = side_shot(3.0f, 48);
    EXPECT_EQ(bits(rig.render(alone).views[0]), settled);
}

/// A red block crosses before a wall of black and white, whose neighbourhoods hold any colour to be likely.
scene::Scene crossing_block() {
    TestScene world;
    Image squares(64, 64, 4);
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x)
            for (int c = 0; c < 4; ++c) squares.at(x, y)[c] = c == 3 || (x + y) % 2 == 0 ? 255 : 0;
    scene::Material wall = unlit(vec3(1.0f));
    scene::Texture texture{world.builder.add(scene::TextureImage{"squares", std::move(squares)}), {}};
    wall.base_color_texture.texture = world.builder.add(std::move(texture));
    wall.base_color_texture.scale = vec2(2.0f);
    world.add(scene::make_box({8.0f, 8.0f, 0.1f}), wall, {.position = {0.0f, 0.0f, -4.0f}});
    const scene::NodeId block = world.add(scene::make_box({0.3f, 3.0f, 0.05f}), unlit({1.0f, 0.0f, 0.0f}));
    scene::Animation animation;
    animation.channels.push_back({.node = block,
                                  .property = scene::AnimatedProperty::Translation,
                                  .interpolation = scene::Interpolation::Linear,
                                  .width = 3,
                                  .times = {0.0f, 1.0f},
                                  .values = {-3, 0, -3, 9, 0, -3}});
    world.builder.add(animation);
    return world.build();
}

double redness(const Picture& picture, float from, float to) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < picture.size.y; ++y) {
        for (std::uint32_t x = 0; x < picture.size.x; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(picture.size.x);
            if (u < from || u > to) continue;
            sum += picture.at(x, y).radiance.x - picture.at(x, y).radiance.y;
            ++count;
        }
    }
    return sum / static_cast<double>(count);
}

TEST_F(HistoryTest, MovingObjectLeavesNoTrail) {
    const scene::Scene scene = crossing_block();
    LightRig rig(device(), scene);
    Picture picture;
    float x = 0.0f;
    for (int i = 20; i <= 25; ++i) {
        Shot shot = side_shot(0.0f);
        shot.time = i * period;
        x = -3.0f + 12.0f * static_cast<float>(to_seconds(shot.time));
        picture = rig.render(shot).views[0];
    }
    write_picture("crossing", shown(picture));
    // Behind the block, less a sample of smooth edge, as far as it came in three frames.
    const float extent = 2.0f * std::tan(radians(25.0f)) * 3.05f;
    const float behind = 0.5f + (x - 0.3f) / extent;
    EXPECT_GT(redness(picture, behind + 0.03f, behind + 0.15f), 0.9);
    EXPECT_LT(std::abs(redness(picture, behind - 0.17f, behind - 0.04f)), 0.01);
}

// Bright spots, smaller than the distance between samples and larger, pass over a dull wall.
TEST_F(HistoryTest, HighlightsNeitherFlashNorHaveDarkRims) {
    const scene::Scene scene = fences();
    LightRig rig(device(), scene);
    for (const float radius_degrees : {0.3f, 3.0f}) {
        int met = 0;
        for (int i = 0; i < 24; ++i) {
            const vec3 middle = transform_direction(turned(0.1f * static_cast<float>(i)), {0, 0, -1});
            Shot shot = side_shot(0.0f);
            shot.read_samples = true;  // the painter wants them
            shot.time = i * period;
            shot.paint = [&](vec3 direction, float) {
                const bool bright = glm::dot(direction, middle) > std::cos(radians(radius_degrees));
                met += bright;
                return shared::LightSample{
                    vec3(bright ? 50.0f : 0.2f), 1.0f, vec3(1.0f), 3.0f, vec3(0.0f), 1.0f};
            };
            const auto picture = radiance_of(rig.render(shot).views[0]);
            const auto [least, most] = std::ranges::minmax(picture.pixels);
            EXPECT_GT(least, 0.16f) << radius_degrees << " degrees, frame " << i;
            if (radius_degrees < 1.0f) {
                EXPECT_LT(most, 1.1f) << i;
            } else {
                EXPECT_GT(most, 45.0f) << i;
            }
        }
        EXPECT_GT(met, 3);
    }
}

TEST_F(HistoryTest, GazeJumpsDoNotSmear) {
    const scene::Scene scene = fences();
    LightRig rig(device(), scene);
    Shot shot = side_shot(0.0f);
    shot.every_pixel = true;
    shot.settings.reference_samples = 32;
    const View view = shot.views[0];
    const FloatImage truth = shown(low_pass(radiance_of(rig.render(shot).views[0]), 1.0f));
    shot = side_shot(0.0f);
    for (int i = 0; i < 6; ++i) {
        shot.time = i * period;
        rig.render(shot);
    }
    shot.time += period;
    shot.fovea.direction = glm::normalize(vec3(-0.6f, 0.4f, -1.0f));
    const FloatImage after = shown(rig.render(shot).views[0]);
    shot.settings.history_temporal = false;
    const FloatImage alone = shown(rig.render(shot).views[0]);
    // What was seen before the jump, from where it was seen, makes the picture better at once.
    EXPECT_LT(change(truth, view, after, view), 0.95 * change(truth, view, alone, view));
}

TEST_F(HistoryTest, GridMayChangeItsSizeBetweenFrames) {
    const scene::Scene scene = fences();
    LightRig rig(device(), scene);
    const auto frame = [&](int i, float scale, bool temporal = true) {
        Shot shot = side_shot(0.0f);
        shot.time = i * period;
        shot.settings.resolution_scale = scale;
        shot.settings.history_temporal = temporal;
        return shown(rig.render(shot).views[0]);
    };
    const View view = side_shot(0.0f).views[0];
    for (int i = 0; i < 8; ++i) frame(i, i % 2 == 0 ? 1.0f : 0.85f);
    const FloatImage with = frame(8, 1.0f), again = frame(9, 0.85f);
    const double alone = change(frame(10, 1.0f, false), view, frame(11, 0.85f, false), view);
    EXPECT_LT(change(with, view, again, view), 0.5 * alone);
    EXPECT_LT(change(with, view, frame(12, 1.0f, false), view), alone);
}

TEST_F(HistoryTest, BothEyesAreTreatedAlike) {
    const scene::Scene scene = crossing_block();
    LightRig rig(device(), scene);
    for (int i = 0; i < 8; ++i) {
        Shot shot = side_shot(0.7f * static_cast<float>(i), 48);
        shot.time = (20 + i) * period;
        View right = shot.views[0];
        right.eye = Eye::Right;
        shot.views.push_back(right);
        const Rendered rendered = rig.render(shot);
        EXPECT_EQ(bits(rendered.views[0]), bits(rendered.views[1])) << i;
    }
}

TEST_F(HistoryTest, ShadowsAreSmoothedAndTexturesAreNot) {
    const auto room = [](bool shaded) {
        TestScene world(vec3(0.2f));
        Image squares(64, 64, 4);
        for (std::uint32_t y = 0; y < 64; ++y)
            for (std::uint32_t x = 0; x < 64; ++x)
                for (int c = 0; c < 4; ++c)
                    squares.at(x, y)[c] = c == 3 || (x / 4 + y / 4) % 2 == 0 ? 255 : 60;
        scene::Material floor = matte(vec3(0.8f));
        scene::Texture texture{world.builder.add(scene::TextureImage{"squares", std::move(squares)}), {}};
        floor.base_color_texture.texture = world.builder.add(std::move(texture));
        world.add(scene::make_box({4.0f, 0.1f, 4.0f}), floor, {.position = {0.0f, -1.0f, -3.0f}});
        // So wide and near that all that is seen lies in its penumbra.
        if (shaded)
            world.add(scene::make_box({1.0f, 0.02f, 1.0f}), matte(vec3(0.5f)),
                      {.position = {0.0f, 1.2f, -3.0f}});
        world.add(scene::AreaLight{"lamp", scene::AreaLightShape::Rectangle, vec3(3.0f), vec3(2.0f)},
                  look_at({0.0f, 2.5f, -3.0f}, {0.0f, 0.0f, -3.0f}));
        return world.build();
    };
    const View view = side_shot(0.0f).views[0];
    const auto picture = [&](LightRig& rig, bool spatial, int samples) {
        start_over(rig);
        Shot shot = side_shot(0.0f);
        shot.settings.history_spatial = spatial;
        shot.settings.shadow_samples = samples;
        return shown(rig.render(shot).views[0]);
    };
    const scene::Scene shaded_room = room(true), open_room = room(false);
    LightRig shaded(device(), shaded_room), open(device(), open_room);
    const FloatImage truth = picture(shaded, false, 256);
    const double noise = change(truth, view, picture(shaded, false, 1), view);
    const FloatImage smoothed = picture(shaded, true, 1);
    const double left = change(truth, view, smoothed, view);
    std::cout << "noise " << noise << ", after the filter " << left << '\n';
    write_picture("smoothed", smoothed);
    EXPECT_LT(left, 0.45 * noise);
    EXPECT_LT(change(picture(open, false, 1), view, picture(open, true, 1), view), 1e-3);
    EXPECT_LT(change(truth, view, picture(shaded, true, 256), view), 0.1 * noise);
}

TEST_F(HistoryTest, VirtualShadowsOnRealSurfacesAreSmoothedToo) {
    TestScene world(vec3(0.2f));
    world.add_real(scene::make_box({4.0f, 0.1f, 4.0f}), vec3(0.8f), 0.0f, 1.0f,
                   {.position = {0.0f, -1.0f, -3.0f}});
    world.add(scene::make_box({1.0f, 0.02f, 1.0f}), matte(vec3(0.5f)), {.position = {0.0f, 1.2f, -3.0f}});
    world.add(scene::AreaLight{"lamp", scene::AreaLightShape::Rectangle, vec3(3.0f), vec3(2.0f)},
              look_at({0.0f, 2.5f, -3.0f}, {0.0f, 0.0f, -3.0f}));
    const scene::Scene scene = world.build();
    LightRig rig(device(), scene);
    const View view = side_shot(0.0f).views[0];
    const auto transmittance = [&](bool spatial, int samples, int frames) {
        start_over(rig);
        FloatImage image(96, 96, 3);
        for (int i = 0; i < frames; ++i) {
            Shot shot = side_shot(0.5f * static_cast<float>(i - frames + 1));
            shot.time = i * period;
            shot.settings.history_spatial = spatial;
            shot.settings.shadow_samples = samples;
            const Picture picture = rig.render(shot).views[0];
            for (std::size_t p = 0; p < picture.pixels.size(); ++p)
                for (std::size_t c = 0; c < 3; ++c)
                    image.pixels[3 * p + c] = picture.pixels[p].transmittance[static_cast<int>(c)];
        }
        return image;
    };
    const FloatImage truth = transmittance(false, 256, 1);
    const double noise = change(truth, view, transmittance(false, 1, 1), view);
    EXPECT_LT(change(truth, view, transmittance(true, 1, 1), view), 0.6 * noise);
    EXPECT_LT(change(truth, view, transmittance(false, 1, 8), view), 0.75 * noise);
}

}  // namespace
}  // namespace foveray::render
