#include "render/scene/light.h"

#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

TEST(EnvironmentUv, middleIsForwardAndUGoesToTheRight) {
    const Environment e = constant_environment(vec3(1));
    const auto expect_uv = [&](vec3 direction, float u, float v) {
        const vec2 uv = environment_uv(e, direction);
        EXPECT_NEAR(uv.x, u, 1e-6f);
        EXPECT_NEAR(uv.y, v, 1e-6f);
    };
    expect_uv({0, 0, -1}, 0.5f, 0.5f);
    expect_uv({1, 0, 0}, 0.75f, 0.5f);
    expect_uv({-1, 0, 0}, 0.25f, 0.5f);
    expect_uv({0, 1, -1e-4f}, 0.5f, 1e-4f / pi);
    expect_uv({0, -1, -1}, 0.5f, 0.75f);
}

TEST(EnvironmentUv, rotationTurnsThePictureCounterClockwiseFromAbove) {
    Environment e = constant_environment(vec3(1));
    e.rotation = pi / 2;
    // What the picture showed at -z now stands a quarter turn to the left, at -x.
    EXPECT_NEAR(environment_uv(e, {-1, 0, 0}).x, 0.5f, 1e-6f);
}

TEST(PlacedLights, areaLightsShineToTheirMinusZ) {
    SceneBuilder builder;
    Node node;
    node.local.translation = {0, 2, 0};
    node.local.rotation = glm::angleAxis(-pi / 2, vec3(1, 0, 0));  // -z turns to -y
    node.area_light = builder.add(AreaLight{"panel", AreaLightShape::Rectangle, {0.5f, 0.25f, 0.0f}, vec3(3)});
    builder.add(node);
    const Scene scene = std::move(builder).build();
    SceneAnimator animator(scene);
    const SceneChanges& now = animator.advance(0);
    ASSERT_EQ(now.area_lights.size(), 1u);
    const PlacedAreaLight& light = now.area_lights[0];
    expect_near(light.center, {0, 2, 0});
    expect_near(glm::normalize(glm::cross(light.half_u, light.half_v)), {0, -1, 0});
    EXPECT_NEAR(glm::length(light.half_u), 0.5f, 1e-6f);
    EXPECT_NEAR(glm::length(light.half_v), 0.25f, 1e-6f);
    expect_near(light.radiance, vec3(3));
}

TEST(Shapes, facesPointOutwards) {
    for (const Mesh& mesh : {make_box({1, 2, 3}), make_sphere(2.0f, 12)}) {
        const Primitive& p = mesh.primitives[0];
        for (std::size_t t = 0; t < p.indices.size(); t += 3) {
            const vec3 a = p.positions[p.indices[t]], b = p.positions[p.indices[t + 1]],
                       c = p.positions[p.indices[t + 2]];
            EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0.0f);
        }
        for (std::size_t i = 0; i < p.normals.size(); ++i)
            EXPECT_GT(glm::dot(p.normals[i], p.positions[i]), 0.0f);
    }
    const Mesh rectangle = make_rectangle({2, 3});
    const Primitive& p = rectangle.primitives[0];
    EXPECT_GT(glm::cross(p.positions[1] - p.positions[0], p.positions[2] - p.positions[0]).y, 0.0f);
    expect_near(p.positions[2], {2, 0, -3});
}

}  // namespace
}  // namespace foveray::scene
