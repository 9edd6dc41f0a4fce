#include <atomic>
#include <random>
#include <thread>

#include "tests/changes/still_life.h"
#include "tests/fakes/gpu_fixture.h"

namespace foveray::app {
namespace {

using LiveSceneTest = fakes::GpuTest;
using ScenePtr = std::shared_ptr<const scene::Scene>;

constexpr Nanoseconds period = nanoseconds_per_second / 90;

/// Some objects, lights and materials, others for every number.
ScenePtr random_life(std::uint32_t number, bool probes = true) {
    std::mt19937 random(number);
    const auto pick = [&](std::uint32_t count) { return random() % count; };
    const auto unit = [&] { return static_cast<float>(pick(1000)) / 999.0f; };
    StillLife life(vec3(0.2f * unit()));
    const std::uint32_t objects = pick(6), lamps = 1 + pick(4);
    for (std::uint32_t i = 0; i < objects; ++i) {
        const vec3 place(2.0f * unit() - 1.0f, -0.25f + 0.5f * unit(), -1.5f - 1.5f * unit());
        scene::Material material = matte({unit(), unit(), unit()});
        material.roughness = unit();
        pick(2) == 0 ? life.add_box(place, material) : life.add_ball(place, material);
    }
    for (std::uint32_t i = 0; i < lamps; ++i)
        life.add_lamp({3.0f * unit() - 1.5f, 1.5f, -1.5f}, {0.0f, -1.0f, -0.2f}, vec3(8.0f * unit()));
    if (probes && pick(4) != 0)
        life.builder.set(scene::ProbeGrid{{3, 2, 3}, vec3(-2, -0.5f, -4), vec3(2, 2, 0)});
    return std::make_shared<const scene::Scene>(life.build());
}

Shot coarse_shot(int frame) {
    Shot shot = side_shot(frame * period, 8);
    shot.settings.resolution_scale = 0.25f;
    return shot;
}

TEST_F(LiveSceneTest, AnotherSceneEveryFrameLeavesNothingBehind) {
    constexpr int frames = 300;
    Offscreen offscreen(device(), random_life(0), 2);
    vk::DeviceSize most_early = 0, most_late = 0;
    for (int i = 1; i <= frames; ++i) {
        const std::uint32_t number = static_cast<std::uint32_t>(i % 50);  // all of them in each part
        offscreen.show(offscreen.prepare(random_life(number)));
        offscreen.draw(coarse_shot(i));
        vk::DeviceSize& most = i <= frames / 2 ? most_early : most_late;
        most = std::max(most, gpu::used_memory(device()));
    }
    EXPECT_LE(most_late, most_early);
}

TEST_F(LiveSceneTest, PicturesAreThoseOfAFreshScene) {
    Offscreen offscreen(device(), random_life(0, false), 2);
    const auto expect_fresh = [&](const ScenePtr& scene) {
        Offscreen fresh(device(), scene, 1);
        fresh.draw(front_shot(0, 24));
        EXPECT_EQ(largest_difference(offscreen.picture(0), fresh.picture(0)), 0);
    };
    const auto show = [&](const ScenePtr& scene) {
        offscreen.show(offscreen.prepare(scene));
        offscreen.draw(front_shot(0, 24));
    };
    for (std::uint32_t i = 1; i <= 20; ++i) show(random_life(i, false));  // without a wait between
    expect_fresh(random_life(20, false));
    // Another kind of shape, so another pipeline.
    StillLife life;
    scene::Shape plane;
    plane.kind = scene::ShapeKind::Plane;
    plane.values = scene::default_values(scene::shape_kind(scene::ShapeKind::Plane).parameters);
    plane.material = life.builder.add(matte({0.2f, 0.4f, 0.9f}));
    scene::Node node;
    node.shape = life.builder.add(std::move(plane));
    node.local.translation = {0.0f, -0.3f, -2.0f};
    life.builder.add(std::move(node));
    const auto scene = std::make_shared<const scene::Scene>(life.build());
    show(scene);
    show(random_life(20, false));
    show(scene);
    expect_fresh(scene);
}

TEST_F(LiveSceneTest, FramesGoOnWhileAnotherThreadMakesScenesReady) {
    constexpr int scenes = 12;
    Offscreen offscreen(device(), random_life(0), 2);
    std::atomic<bool> wanted = true, ready = false;
    std::optional<render::LiveScene::Next> next;
    std::thread maker([&] {
        for (std::uint32_t i = 1; i <= scenes; ++i) {
            while (!wanted) std::this_thread::yield();
            next = offscreen.prepare(random_life(i));
            wanted = false;
            ready = true;
        }
    });
    int shown = 0, frames_between = 0;
    for (int i = 0; shown < scenes; ++i) {
        if (ready.exchange(false)) {
            offscreen.show(std::move(*next));
            next.reset();
            ++shown;
            wanted = true;
        } else {
            ++frames_between;
        }
        offscreen.draw(coarse_shot(i));
    }
    maker.join();
    EXPECT_GT(frames_between, scenes);
    // What came last is shown.
    Offscreen fresh(device(), random_life(scenes), 1);
    Shot shot = front_shot(0, 24);
    shot.settings.probes = false;
    offscreen.draw(shot);
    fresh.draw(shot);
    EXPECT_EQ(largest_difference(offscreen.picture(0), fresh.picture(0)), 0);
}

TEST_F(LiveSceneTest, ProbesKeepWhatTheyKnowWhileTheyStayWhereTheyAre) {
    const auto lit_room = [](vec3 ball, std::uint32_t probes) {
        StillLife life(vec3(0.0f));
        life.add_ball(ball, matte(vec3(0.5f)));
        life.add_lamp({0.0f, 1.5f, -1.5f}, {0.0f, -1.0f, 0.0f}, vec3(20.0f));
        life.builder.set(scene::ProbeGrid{{probes, 3, 4}, vec3(-2, -0.5f, -4), vec3(2, 2, 0)});
        return std::make_shared<const scene::Scene>(life.build());
    };
    const ScenePtr first = lit_room({1.0f, 0.0f, -3.5f}, 4), second = lit_room({1.0f, 0.1f, -3.5f}, 4),
                   other_grid = lit_room({1.0f, 0.1f, -3.5f}, 5);
    Shot shot = front_shot(0, 16);
    const auto run = [&](Offscreen& where, int first_frame, int frames) {
        for (int i = 0; i < frames; ++i) {
            shot.time = (first_frame + i) * period;
            where.draw(shot);
        }
        return where.picture(0);
    };
    Offscreen offscreen(device(), first, 2);
    run(offscreen, 0, 60);
    offscreen.show(offscreen.prepare(second));
    const Image kept = run(offscreen, 60, 1), settled = run(offscreen, 61, 30);
    offscreen.show(offscreen.prepare(other_grid));
    const Image anew = run(offscreen, 91, 1);
    EXPECT_LT(4.0 * mean_difference(kept, settled), mean_difference(anew, settled));
    // Probes elsewhere start as they do with a first scene.
    Offscreen other(device(), other_grid, 2);
    EXPECT_EQ(largest_difference(anew, run(other, 91, 1)), 0);
}

TEST_F(LiveSceneTest, MeshesThatBothScenesHaveAreShared) {
    const auto globe = [](const scene::Material& material, vec3 place) {
        StillLife life;
        scene::Mesh mesh = scene::make_sphere(0.5f, 96);
        mesh.primitives[0].material = life.builder.add(material);
        scene::Node node;
        node.mesh = life.builder.add(std::move(mesh));
        node.local.translation = place;
        life.builder.add(std::move(node));
        life.add_lamp({0.5f, 1.5f, -1.5f}, {-0.2f, -1.0f, -0.2f}, vec3(20.0f));
        return std::make_shared<const scene::Scene>(life.build());
    };
    scene::Material see_through = matte({0.1f, 0.8f, 0.1f});
    see_through.base_color.a = 0.5f;
    see_through.alpha_mode = scene::AlphaMode::Blend;
    const ScenePtr first = globe(matte(vec3(0.5f)), {-0.3f, 0.0f, -2.0f}),
                   second = globe(matte({0.9f, 0.1f, 0.1f}), {0.3f, 0.0f, -2.5f}),
                   third = globe(see_through, {0.0f, 0.0f, -2.0f});
    const vk::DeviceSize before = gpu::used_memory(device());
    Offscreen offscreen(device(), first, 2);
    const vk::DeviceSize whole = gpu::used_memory(device()) - before;
    std::optional<render::LiveScene::Next> next = offscreen.prepare(second);
    const vk::DeviceSize more = gpu::used_memory(device()) - before - whole;
    EXPECT_LT(4 * more, whole);
    // Built of the same triangles, with the other materials' shaders.
    for (const ScenePtr& scene : {second, third}) {
        offscreen.show(offscreen.prepare(scene));
        offscreen.draw(front_shot(0, 32));
        Offscreen fresh(device(), scene, 1);
        fresh.draw(front_shot(0, 32));
        EXPECT_EQ(largest_difference(offscreen.picture(0), fresh.picture(0)), 0);
    }
}

TEST_F(LiveSceneTest, MorePixelsAndProbeRaysNeedNoWait) {
    // Buffers grow in the middle of running frames; what they replace is still in use.
    Offscreen offscreen(device(), random_life(3), 3);
    for (int i = 0; i < 24; ++i) {
        Shot shot = side_shot(i * period, static_cast<std::uint32_t>(4 + 2 * i));
        shot.settings.probe_rays = 16 + 8 * (i % 5);
        shot.settings.resolution_scale = 0.4f + 0.02f * static_cast<float>(i);
        shot.settings.shadow_samples = i % 2 == 0 ? 4 : 16;
        offscreen.draw(shot);
    }
}

}  // namespace
}  // namespace foveray::app
