// Probes notice that a user's shape has changed though nothing of the scene has: its code, or what its code
// makes of the session's time.
#include "render/user_shapes/compile.h"
#include "tests/changes/still_life.h"
#include "tests/fakes/gpu_fixture.h"

namespace foveray::app {
namespace {

using ShapeProbesTest = fakes::GpuTest;

/// A slab that shines behind a floor.
std::string slab(const std::string& color) {
    return "float distance_at(vec3 p, float time) {\n"
           "    vec3 q = abs(p) - vec3(0.9, 0.4, 0.05);\n"
           "    return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);\n"
           "}\n"
           "vec4 color_at(vec3 p, vec3 normal, float time) { return vec4(" +
           color + ", 1.0); }\n";
}

std::shared_ptr<const scene::Scene> lit_by(const std::string& code) {
    scene::SceneBuilder builder;
    builder.set(scene::constant_environment(vec3(0.0f)));
    scene::Mesh floor = scene::make_rectangle(vec2(1.0f));
    floor.primitives[0].material = builder.add(matte(vec3(1.0f)));
    scene::Node floor_node, slab_node;
    floor_node.mesh = builder.add(std::move(floor));
    builder.add(std::move(floor_node));
    scene::Shape shape;
    shape.kind = scene::ShapeKind::User;
    shape.user = builder.add(scene::UserShape{scene::parse_user_shape("slab.glsl", code), {}});
    shape.user_bounds = {vec3(-1.0f), vec3(1.0f)};
    shape.material = builder.add(unlit(vec3(1.0f)));
    slab_node.shape = builder.add(std::move(shape));
    slab_node.local.translation = {0.0f, 0.5f, -0.9f};
    builder.add(std::move(slab_node));
    builder.set(scene::ProbeGrid{{5, 3, 5}, vec3(-1.0f, 0.0f, -1.0f), vec3(1.0f, 1.0f, 1.0f)});
    return std::make_shared<const scene::Scene>(std::move(builder).build());
}

render::UserShaders shaders_of(const scene::Scene& scene) {
    return {user_shapes::compile(scene.user_shapes[0])};
}

/// Light on the floor after so many frames more.
vec3 floor_light(Offscreen& offscreen, Nanoseconds& time, Nanoseconds step, int frames) {
    Shot shot;
    View view;
    view.size = uvec2(4);
    view.fov = {-0.05f, 0.05f, 0.05f, -0.05f};
    view.stage_from_eye = {glm::angleAxis(-0.5f * pi, vec3(1.0f, 0.0f, 0.0f)), {0.0f, 0.9f, -0.2f}};
    shot.views = {view};
    shot.settings.ambient_occlusion_samples = 0;
    shot.settings.tone_mapping = "none";
    shot.settings.exposure_ev = 1.0f;
    for (int i = 0; i < frames; ++i) {
        shot.time = time += step;
        offscreen.draw(shot);
    }
    const Image picture = offscreen.picture(0);
    vec3 sum(0.0f);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        if (i % 4 < 3) sum[i % 4] += linear_from_srgb(static_cast<float>(picture.pixels[i]) / 255.0f) / 16.0f;
    return sum;
}

TEST_F(ShapeProbesTest, OtherCodeArrivesAsFastAsAnyChange) {
    const auto red = lit_by(slab("1.0, 0.0, 0.0")), green = lit_by(slab("0.0, 1.0, 0.0"));
    Offscreen offscreen(device(), red, 2, shaders_of(*red));
    Nanoseconds time = 0;
    const vec3 before = floor_light(offscreen, time, nanoseconds_per_second, 30);
    EXPECT_GT(before.x, 0.1f);
    EXPECT_LT(before.y, 0.01f * before.x);
    offscreen.show(offscreen.prepare(red, shaders_of(*green)));  // as a saved file is: the scene stays
    const vec3 after = floor_light(offscreen, time, nanoseconds_per_second / 90, 36);
    EXPECT_LT(after.x, 0.55f * before.x);
    EXPECT_GT(after.y, 0.45f * before.x);
}

TEST_F(ShapeProbesTest, WhatFollowsTheTimeIsFollowed) {
    const auto scene = lit_by(slab("time < 30.001 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)"));
    Offscreen offscreen(device(), scene, 2, shaders_of(*scene));
    Nanoseconds time = 0;
    const vec3 before = floor_light(offscreen, time, nanoseconds_per_second, 30),
               after = floor_light(offscreen, time, nanoseconds_per_second / 90, 36);
    EXPECT_GT(before.x, 0.1f);
    EXPECT_LT(after.x, 0.55f * before.x);
    EXPECT_GT(after.y, 0.45f * before.x);
}

}  // namespace
}  // namespace foveray::app
