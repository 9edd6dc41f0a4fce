#include "render/scene/load_scene.h"

#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

using fakes::GltfBuilder;

class LoadScene : public GltfTest {
  protected:
    Scene load_scaled(float scale) {
        GltfBuilder gltf = GltfBuilder::triangle();
        gltf.json["nodes"][0]["scale"] = {scale, scale, scale};
        gltf.json["nodes"][0]["translation"] = {10, 20, 30};
        return load_scene(folder_.write("model.gltf", gltf.text()));
    }
};

TEST_F(LoadScene, aBareModelStandsOnTheFloorInFrontOfTheWearer) {
    const Scene scene = load_scaled(1.0f);
    expect_near(scene.bounds.min, {-0.5f, 0, -1.5f}, 1e-4f);
    expect_near(scene.bounds.max, {0.5f, 1, -1.5f}, 1e-4f);
    EXPECT_EQ(scene.world_from_stage, Pose{});
}

TEST_F(LoadScene, hugeAndTinyModelsAreScaled) {
    for (const float scale : {50.0f, 0.01f}) {
        const Scene scene = load_scaled(scale);
        EXPECT_NEAR(scene.bounds.extent().x, 1.2f, 1e-4f);
        EXPECT_NEAR(scene.bounds.min.y, 0.0f, 1e-4f);
        EXPECT_NEAR(scene.bounds.center().z, -1.5f, 1e-4f);
    }
}

TEST_F(LoadScene, aBareModelGetsAFloorAndLight) {
    const Scene scene = load_scaled(1.0f);
    ASSERT_EQ(scene.real_surfaces.size(), 1u);
    EXPECT_EQ(scene.real_surfaces[0].name, "floor");
    EXPECT_EQ(scene.meshes[scene.real_surfaces[0].mesh].primitives[0].positions[0].y, 0.0f);
    SceneAnimator animator(scene);
    const SceneChanges& now = animator.advance(0);
    ASSERT_EQ(now.lights.size(), 1u);
    EXPECT_LT(now.lights[0].direction.y, -0.5f);
    EXPECT_FALSE(scene.environment.radiance.empty());
    EXPECT_EQ(scene.instances.size(), 1u);  // the floor is not one of them
}

TEST_F(LoadScene, aModelWithLightsKeepsToThem) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    gltf.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const Scene scene = load_scene(folder_.write("model.gltf", gltf.text()));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::Point);
}

TEST_F(LoadScene, theSameFileGivesTheSameScene) {
    const Scene a = load_scaled(1.0f), b = load_scaled(1.0f);
    EXPECT_EQ(a.nodes.size(), b.nodes.size());
    EXPECT_EQ(a.meshes[0].primitives[0].positions, b.meshes[0].primitives[0].positions);
    EXPECT_EQ(a.bounds.min, b.bounds.min);
}

}  // namespace
}  // namespace foveray::scene
