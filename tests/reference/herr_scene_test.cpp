#include <gtest/gtest.h>

#include "base/headset_profile.h"
#include "render/reference/tracer.h"
#include "render/scene/load_scene.h"

/// assets/scenes/herr.json is as section 4.1 of HERR describes the scene of its measurements.
namespace foveray::reference {
namespace {

class HerrScene : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        scene_ = new scene::Scene(scene::load_scene(assets_folder() / "scenes/herr.json"));
    }
    static void TearDownTestSuite() { delete scene_; }

    static scene::Scene* scene_;
};
scene::Scene* HerrScene::scene_ = nullptr;

TEST_F(HerrScene, hasNineObjectsOfTriangles) {
    std::size_t triangles = 0;
    for (const scene::Instance& instance : scene_->instances) {
        for (const scene::Primitive& p : scene_->meshes[instance.mesh].primitives) {
            triangles += p.indices.size() / 3;
        }
    }
    EXPECT_EQ(scene_->instances.size(), 9u);
    EXPECT_TRUE(scene_->shapes.empty());
    EXPECT_GE(triangles, 280'000u);
    EXPECT_LE(triangles, 300'000u);
    const vec3 extent = scene_->bounds.extent();
    EXPECT_LE(extent.x, 5.001f);
    EXPECT_LE(extent.y, 2.5f);
    EXPECT_LE(extent.z, 10.001f);
    EXPECT_TRUE(glm::all(glm::greaterThan(extent, 0.95f * vec3(5.0f, 2.5f, 10.0f))));
}

TEST_F(HerrScene, reflectsEverywhere) {
    for (const scene::Mesh& mesh : scene_->meshes) {
        for (const scene::Primitive& p : mesh.primitives) {
            EXPECT_LT(scene_->materials[p.material].roughness, 0.5f)
                << mesh.name;  // lighting.reflection_max_roughness
            EXPECT_EQ(scene_->materials[p.material].alpha_mode, scene::AlphaMode::Opaque) << mesh.name;
        }
    }
}

TEST_F(HerrScene, lampCircles) {
    ASSERT_EQ(scene_->area_lights.size(), 1u);
    EXPECT_TRUE(scene_->lights.empty());
    scene::SceneAnimator animator(*scene_);
    const auto lamp_at = [&](double seconds) {
        return animator.advance(static_cast<Nanoseconds>(seconds * 1e9)).area_lights[0];
    };
    const vec3 middle = 0.5f * (lamp_at(0.0).center + lamp_at(5.0).center);
    EXPECT_GT(glm::distance(lamp_at(0.0).center, middle), 0.5f);
    for (const double seconds : {0.0, 1.1, 3.7, 6.2, 9.9}) {
        const scene::PlacedAreaLight lamp = lamp_at(seconds);
        EXPECT_NEAR(glm::distance(lamp.center, middle), glm::distance(lamp_at(0.0).center, middle), 1e-3f);
        EXPECT_LT(glm::cross(lamp.half_u, lamp.half_v).y, 0.0f);
        EXPECT_LT(lamp.center.y, scene_->bounds.max.y);
    }
}

TEST_F(HerrScene, closesRoundTheViewer) {
    scene::SceneAnimator animator(*scene_);
    const Tracer tracer(*scene_, animator.advance(0));
    const HeadsetProfile headset = read_headset_profile("varjo-xr1");
    ASSERT_TRUE(scene_->nodes.back().camera);
    const vec3 head = scene_->nodes.back().local.translation;
    int rays = 0, hits = 0;
    for (const float yaw : {0.0f, 60.0f, 120.0f, 180.0f, 240.0f, 300.0f}) {
        for (const float pitch : {-40.0f, 0.0f, 40.0f}) {
            const quat turn =
                glm::angleAxis(radians(yaw), vec3(0, 1, 0)) * glm::angleAxis(radians(pitch), vec3(1, 0, 0));
            const Fov& fov = headset.views.front().fov;
            for (int i = 0; i < 100; ++i) {
                const vec2 at = (vec2(i % 10, i / 10) + 0.5f) / 10.0f;
                const vec3 direction(glm::mix(std::tan(fov.left), std::tan(fov.right), at.x),
                                     glm::mix(std::tan(fov.down), std::tan(fov.up), at.y), -1.0f);
                ++rays;
                hits += tracer.closest({dvec3(head), dvec3(turn * direction)}, Side::FrontOnly).has_value();
            }
        }
    }
    EXPECT_GE(hits, 0.95 * rays);
}

}  // namespace
}  // namespace foveray::reference
