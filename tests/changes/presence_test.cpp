#include "tests/changes/still_life.h"
#include "tests/fakes/gpu_fixture.h"

namespace foveray::app {
namespace {

class PresenceTest : public fakes::GpuTest {
  protected:
    Easel easel_{device()};
};

constexpr Nanoseconds second = nanoseconds_per_second;
const std::vector<scene::Presence> later = {{second, 2 * second}};

/// A table with a red box and a blue ball, which are there `when`, and lamps above.
scene::Scene scene_with(bool box_and_ball, std::vector<scene::Presence> when = {}) {
    StillLife life;
    if (box_and_ball) {
        life.add_box({-0.3f, -0.25f, -2.0f}, matte({0.8f, 0.1f, 0.1f}), when);
        life.add_ball({0.4f, -0.25f, -1.8f}, matte({0.1f, 0.1f, 0.8f}), when);
    }
    life.add_lamp({0.5f, 1.5f, -1.5f}, {-0.2f, -1.0f, -0.2f}, vec3(20.0f));
    return life.build();
}

TEST_F(PresenceTest, WhatIsAbsentIsMetByNoRayAndComesAndGoesAtItsTime) {
    const Easel::Drawn without = easel_.draw(scene_with(false), front_shot(0)),
                       with = easel_.draw(scene_with(true), front_shot(0));
    ASSERT_GT(mean_difference(without.picture, with.picture), 2.0);
    Offscreen& offscreen = easel_.put(scene_with(true, later));
    offscreen.finish();
    for (const auto& [time, expected] :
         {std::pair{Nanoseconds{0}, &without}, {second, &with}, {2 * second, &without}}) {
        offscreen.draw(front_shot(time));
        EXPECT_EQ(offscreen.finish().back().rays, expected->rays) << time;
        EXPECT_EQ(largest_difference(offscreen.picture(0), expected->picture), 0) << time;
    }
}

TEST_F(PresenceTest, AbsentLightsCostNoRaysAndTheOthersStayAsTheyAre) {
    // The lamp between the others shines away from everything, so that only its absence could be seen.
    const auto lamps = [](const std::vector<scene::Presence>& when, bool middle) {
        StillLife life(vec3(0.0f));
        life.add_box({-0.3f, -0.25f, -2.0f}, matte({0.8f, 0.1f, 0.1f}));
        life.add_lamp({-0.8f, 1.5f, -1.5f}, {0.2f, -1.0f, -0.2f}, vec3(10.0f));
        if (middle) life.add_lamp({0.0f, 4.0f, -1.5f}, {0.0f, 1.0f, 0.0f}, vec3(10.0f), when);
        life.add_lamp({0.8f, 1.5f, -1.5f}, {-0.2f, -1.0f, -0.2f}, vec3(10.0f));
        return life.build();
    };
    const scene::Scene scene = lamps({{0, second}}, true);
    Offscreen& offscreen = easel_.put(scene);
    for (const int samples : {4, 64}) {  // 64: looked at first, all taken in penumbras
        Shot shot = front_shot(0);
        shot.settings.shadow_samples = samples;
        offscreen.draw(shot);
        const Image before = offscreen.picture(0);
        shot.time = second;
        offscreen.draw(shot);
        EXPECT_EQ(largest_difference(before, offscreen.picture(0)), 0) << samples;
    }
    // What is there takes as many rays as if there were no other.
    const auto rays = [&](const scene::Scene& of) { return easel_.draw(of, front_shot(second)).rays; };
    EXPECT_EQ(rays(scene), rays(lamps({}, false)));
}

TEST_F(PresenceTest, ALightThatGoesTakesItsLightAlong) {
    const auto lit = [](bool second_lamp, std::vector<scene::Presence> when) {
        StillLife life(vec3(0.0f));
        life.add_lamp({-0.8f, 1.5f, -1.5f}, {0.2f, -1.0f, -0.2f}, vec3(10.0f));
        if (second_lamp)
            life.add_lamp({0.8f, 1.5f, -1.5f}, {-0.2f, -1.0f, -0.2f}, vec3(10.0f, 2.0f, 2.0f), when);
        return life.build();
    };
    const scene::Scene scene = lit(true, {{0, second}});
    const Image both = easel_.draw(scene, front_shot(0)).picture,
                after = easel_.draw(scene, front_shot(second)).picture,
                one = easel_.draw(lit(false, {}), front_shot(0)).picture;
    EXPECT_GT(mean_difference(both, after), 2.0);
    EXPECT_EQ(largest_difference(after, one), 0);
}

TEST_F(PresenceTest, NothingOfWhatHasGoneStaysInThePeriphery) {
    const auto look = [](std::vector<scene::Presence> when) {
        StillLife life(vec3(0.2f));
        life.add_box({-0.1f, 0.0f, -1.5f}, unlit({1.0f, 0.0f, 0.0f}), std::move(when));
        return life.build();
    };
    constexpr Nanoseconds period = second / 90;
    const scene::Scene scene = look({{0, 10 * period}}), never = look({{second, 2 * second}});
    // Without shadows, so that nothing else changes.
    const auto shot = [](int frame) {
        Shot result = side_shot(frame * period);
        result.settings.shadows = false;
        result.settings.ambient_occlusion_samples = 0;
        return result;
    };
    Offscreen& offscreen = easel_.put(scene);
    for (int i = 0; i < 10; ++i) offscreen.draw(shot(i));
    const Image before = offscreen.picture(0);
    offscreen.draw(shot(10));
    const Image after = offscreen.picture(0), expected = easel_.draw(never, shot(10)).picture;
    EXPECT_GT(mean_difference(before, expected), 4.0);
    EXPECT_LE(largest_difference(after, expected), 3);
}

/// A white room with a lamp, and a second one that goes out.
scene::Scene room(std::vector<scene::Presence> when) {
    StillLife life(vec3(0.0f));
    const auto wall = [&](vec3 half_size, vec3 place, vec3 color) {
        scene::Mesh mesh = scene::make_box(half_size);
        mesh.primitives[0].material = life.builder.add(matte(color));
        scene::Node node;
        node.mesh = life.builder.add(std::move(mesh));
        node.local.translation = place;
        life.builder.add(std::move(node));
    };
    wall({2.0f, 0.1f, 2.0f}, {0, 2.1f, -2.0f}, vec3(0.7f));
    wall({0.1f, 2.0f, 2.0f}, {-2.1f, 0.5f, -2.0f}, vec3(0.7f, 0.2f, 0.2f));
    wall({0.1f, 2.0f, 2.0f}, {2.1f, 0.5f, -2.0f}, vec3(0.2f, 0.7f, 0.2f));
    wall({2.0f, 2.0f, 0.1f}, {0, 0.5f, -4.1f}, vec3(0.7f));
    // Both shine to the ceiling: below, all light is indirect.
    life.add_lamp({-0.8f, 1.4f, -2.0f}, {0, 1, 0}, vec3(30.0f));
    life.add_lamp({0.8f, 1.4f, -2.0f}, {0, 1, 0}, vec3(120.0f), std::move(when));
    life.builder.set(scene::ProbeGrid{{5, 4, 5}, {-2.0f, -0.5f, -4.0f}, {2.0f, 2.0f, 0.0f}});
    return life.build();
}

TEST_F(PresenceTest, ProbesFollowALightThatGoes) {
    constexpr Nanoseconds period = second / 30;
    const scene::Scene scene = room({{0, second}}), never = room({{100 * second, 101 * second}});
    Shot small = front_shot(0, 1);
    const auto run = [&](Offscreen& where, int first, int end) {
        for (int i = first; i < end; ++i) {
            small.time = i * period;
            where.draw(small);
        }
    };
    Offscreen& offscreen = easel_.put(scene);
    run(offscreen, 0, 30);
    offscreen.draw(front_shot(30 * period - 1, 24));
    const Image bright = offscreen.picture(0);
    run(offscreen, 30, 60);  // a second
    offscreen.draw(front_shot(60 * period, 24));
    const Image after = offscreen.picture(0);
    run(easel_.put(never), 0, 60);
    offscreen.draw(front_shot(60 * period, 24));
    const Image expected = offscreen.picture(0);
    const double before = mean_difference(bright, expected), left = mean_difference(after, expected);
    EXPECT_GT(before, 20.0);
    EXPECT_LT(left, 0.2 * before);
}

TEST_F(PresenceTest, MaterialsAreSeenAsTheyAreNow) {
    const auto keys = [](scene::AnimatedProperty property, std::vector<float> from, std::vector<float> to) {
        scene::AnimationChannel channel;
        channel.property = property;
        channel.width = static_cast<std::uint32_t>(from.size());
        channel.times = {0.0f, 2.0f};
        channel.values = from;
        channel.values.insert(channel.values.end(), to.begin(), to.end());
        return channel;
    };
    using scene::AnimatedProperty;
    scene::Material start = matte({1.0f, 0.0f, 0.0f}), end = matte({0.0f, 0.0f, 1.0f});
    start.solid = end.solid = false;
    start.roughness = 0.1f, end.roughness = 0.9f;
    end.emissive = {0.5f, 0.0f, 0.0f};
    end.base_color.a = 0.4f;
    end.transmission = 0.5f;
    scene::Material half = start;
    half.base_color = 0.5f * (start.base_color + end.base_color);
    half.roughness = 0.5f;
    half.emissive = 0.5f * end.emissive;
    half.transmission = 0.25f;
    const auto scene_of = [&](const scene::Material& material, bool animated) {
        StillLife life;
        life.add_box({-0.35f, -0.2f, -2.0f}, material);
        const scene::MaterialId box =
            static_cast<scene::MaterialId>(life.builder.so_far().materials.size() - 1);
        life.add_ball({0.35f, -0.2f, -2.0f}, material);
        life.add_box({0.0f, -0.2f, -3.0f}, matte({0.2f, 0.8f, 0.2f}));
        life.add_lamp({0.5f, 1.5f, -1.5f}, {-0.2f, -1.0f, -0.2f}, vec3(20.0f));
        if (!animated) return life.build();
        for (const scene::MaterialId id : {box, box + 1}) {
            scene::Animation animation;
            animation.channels = {keys(AnimatedProperty::BaseColor, {1, 0, 0}, {0, 0, 1}),
                                  keys(AnimatedProperty::Alpha, {1}, {0.4f}),
                                  keys(AnimatedProperty::Roughness, {0.1f}, {0.9f}),
                                  keys(AnimatedProperty::Emissive, {0, 0, 0}, {0.5f, 0, 0}),
                                  keys(AnimatedProperty::Transmission, {0}, {0.5f})};
            for (scene::AnimationChannel& channel : animation.channels) channel.material = id;
            life.builder.add(std::move(animation));
        }
        return life.build();
    };
    for (scene::Material* material : {&half, &end}) material->alpha_mode = scene::AlphaMode::Blend;
    const scene::Scene scene = scene_of(start, true);
    const scene::Material* expected[] = {&start, &half, &end};
    const auto time_of = [](int i) { return i == 2 ? 2 * second - 1 : i * second; };
    std::vector<Image> seen;
    Offscreen& offscreen = easel_.put(scene);
    for (int i = 0; i < 3; ++i) {
        offscreen.draw(front_shot(time_of(i)));
        seen.push_back(offscreen.picture(0));
    }
    Image last;
    for (int i = 0; i < 3; ++i) {
        const Image now = seen[static_cast<std::size_t>(i)],
                    fresh = easel_.draw(scene_of(*expected[i], false), front_shot(0)).picture;
        EXPECT_LE(largest_difference(now, fresh), 1) << i;
        if (!last.empty()) {
            EXPECT_GT(mean_difference(now, last), 1.0) << i;
        }
        last = now;
    }
}

}  // namespace
}  // namespace foveray::app
