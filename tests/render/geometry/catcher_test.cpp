#include <cmath>

#include "render/scene/scene_builder.h"
#include "shaders/shared/ray_types.h"
#include "shaders/shared/surface.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/geometry/comparison.h"
#include "tests/render/geometry/scene_rig.h"

namespace foveray::render {
namespace {

using CatcherTest = fakes::GpuTest;

View look_along(vec3 position, vec3 axis, float angle) {
    View view = view_forward(5.0f, {3, 3});
    view.stage_from_eye = {glm::angleAxis(angle, axis), position};
    return view;
}

TEST_F(CatcherTest, realSurfacesAreFoundFromBothSidesWithTheirOwnValues) {
    scene::SceneBuilder builder;
    scene::Node ball;  // under the floor
    ball.mesh = builder.add(scene::make_sphere(0.3f, 8));
    ball.local.translation = {0, -1, 0};
    builder.add(ball);
    scene::RealSurface wall;
    wall.mesh = builder.add(scene::make_box(vec3(1, 1, 0.1f)));
    wall.stage_from_object = glm::translate(mat4(1.0f), vec3(0, 1, -5));
    builder.add(wall);
    scene::RealSurface floor;
    floor.mesh = builder.add(scene::make_rectangle(vec2(3.0f)));
    floor.albedo = {0.1f, 0.2f, 0.3f};
    floor.reflectance = 0.05f;
    floor.roughness = 0.35f;
    builder.add(floor);
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    EXPECT_EQ(rig.surfaces(0, std::vector{view_forward(1, {1, 1})}).size(), 1u);
    EXPECT_EQ(rig.masks(), (std::vector{shared::MASK_VIRTUAL, shared::MASK_REAL, shared::MASK_REAL}));

    // From above, from below, and level at the wall; the stage stands turned and moved in the world.
    const Pose world_from_stage{glm::angleAxis(0.7f, vec3(0, 1, 0)), {10, 0, -4}};
    const std::array views = {look_along({0.5f, 2, 0.5f}, {1, 0, 0}, -pi / 2),
                              look_along({1, -2, 1}, {1, 0, 0}, pi / 2), look_along({0, 1, 0}, {1, 0, 0}, 0)};
    const auto found = rig.surfaces(1, views, world_from_stage);
    const auto& above = found[4];
    EXPECT_EQ(above.kind, shared::SURFACE_REAL);
    EXPECT_EQ(above.flags, 0u);
    EXPECT_NEAR(above.distance, 2.0f, 1e-4f);
    expect_near(above.position, transform_point(world_from_stage, {0.5f, 0, 0.5f}), 1e-4f, "position");
    expect_near(above.normal, {0, 1, 0}, 1e-5f, "normal");
    const float rounding = 5e-4f;  // to halves
    expect_near(above.base_color, floor.albedo, rounding, "albedo");
    EXPECT_NEAR(above.metallic, floor.reflectance, rounding);
    EXPECT_NEAR(above.roughness, floor.roughness, rounding);
    EXPECT_EQ(above.material, 1u);
    EXPECT_EQ(above.instance, 2u);
    EXPECT_EQ(above.alpha, 1.0f);
    const auto& below = found[9 + 4];
    EXPECT_EQ(below.kind, shared::SURFACE_REAL);
    EXPECT_EQ(below.flags, shared::SURFACE_FLAG_BACK_FACE | shared::SURFACE_FLAG_INSIDE);
    expect_near(below.normal, {0, -1, 0}, 1e-5f, "normal from below");
    const auto& level = found[18 + 4];
    EXPECT_EQ(level.material, 0u);
    EXPECT_NEAR(level.distance, 4.9f, 1e-3f);
    expect_near(level.normal, transform_direction(world_from_stage, {0, 0, 1}), 1e-5f, "wall");
}

TEST_F(CatcherTest, theStageMovesThroughTheWorld) {
    scene::SceneBuilder builder;
    scene::RealSurface floor;
    floor.mesh = builder.add(scene::make_rectangle(vec2(3.0f)));
    builder.add(floor);
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    const std::array views = {look_along({0, 2, 0}, {1, 0, 0}, -pi / 2)};
    for (const auto& s : rig.surfaces(0, views))
        expect_near(s.previous_position, s.position, 1e-6f, "at rest");
    const Pose moved{quat(1, 0, 0, 0), {1, 0.5f, 0}};
    for (const auto& s : rig.surfaces(1, views, moved)) {
        expect_near(s.previous_position, s.position - vec3(1, 0.5f, 0), 1e-5f, "moved");
    }
    for (const auto& s : rig.surfaces(2, views, moved))
        expect_near(s.previous_position, s.position, 1e-6f, "again at rest");
}

}  // namespace
}  // namespace foveray::render
