#include "render/scene/load_scene.h"
#include "tests/fakes/expect_fault.h"
#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

class ChangingScene : public GltfTest {
  protected:
    Scene load(const Json& objects, const Json& lights = Json::array()) {
        const Json json = {
            {"format", "foveray-scene"}, {"version", 1}, {"objects", objects}, {"lights", lights}};
        return load_scene(folder_.write("scene.json", json.dump()));
    }
    void expect_bad(const Json& object, const std::string& part) {
        fakes::expect_fault([&] { load(Json::array({object})); }, ExitCode::BadInput, part);
    }
};

TEST_F(ChangingScene, ObjectsAreThereFromTheFirstMomentUntilBeforeTheSecond) {
    const Scene scene = load({{{"shape", "sphere"}, {"present", {{1, 2}, {4}}}}});
    SceneAnimator animator(scene);
    const auto present = [&](double s) {
        return animator.advance(from_seconds(s)).shape_instances[0].present;
    };
    EXPECT_FALSE(present(0.0));
    EXPECT_FALSE(present(0.999999999));
    EXPECT_TRUE(present(1.0));
    EXPECT_TRUE(present(1.999999999));
    EXPECT_FALSE(present(2.0));
    EXPECT_TRUE(present(4.0));
    EXPECT_TRUE(present(1e6));
    EXPECT_FALSE(present(3.0));
}

TEST_F(ChangingScene, WhatHangsFromSomethingAbsentIsAbsent) {
    const Scene scene =
        load({{{"name", "arm"}, {"mesh", {{{"kind", "box"}}}}, {"present", {{1, 2}}}},
              {{"name", "hand"}, {"shape", "sphere"}, {"parent", "arm"}, {"present", {{0, 1.5}}}}});
    SceneAnimator animator(scene);
    const auto both = [&](double s) {
        const SceneChanges& now = animator.advance(from_seconds(s));
        return std::pair(now.instances[0].present, now.shape_instances[0].present);
    };
    EXPECT_EQ(both(0.5), std::pair(false, false));
    EXPECT_EQ(both(1.2), std::pair(true, true));
    EXPECT_EQ(both(1.7), std::pair(true, false));
}

TEST_F(ChangingScene, ComingAndGoingChangesTheSceneButIsNoMotion) {
    const Scene scene =
        load({{{"shape", "sphere"},
               {"present", {{0, 1}, {2, 4}}},
               {"animation",
                {{{"property", "translation"}, {"times", {0, 10}}, {"values", {{0, 0, 0}, {10, 0, 0}}}}}}}});
    SceneAnimator animator(scene);
    animator.advance(0);
    EXPECT_TRUE(animator.advance(from_seconds(0.5)).shape_instances[0].moved);
    EXPECT_TRUE(animator.advance(from_seconds(1.5)).transforms_changed);
    EXPECT_FALSE(animator.advance(from_seconds(1.5)).transforms_changed);
    const SceneChanges& back = animator.advance(from_seconds(2.5));
    EXPECT_TRUE(back.transforms_changed);
    EXPECT_FALSE(back.shape_instances[0].moved);
    expect_near(vec3(back.shape_instances[0].previous_world_from_object[3]), {2.5f, 0, 0});
    EXPECT_TRUE(animator.advance(from_seconds(3.0)).shape_instances[0].moved);
}

TEST_F(ChangingScene, LightsKeepTheirNumbersWhenOthersGo) {
    const Json point = {{"type", "point"}, {"position", {0, 1, 0}}};
    Json fleeting = point;
    fleeting["present"] = {{0, 1}};
    const Json area = {{"type", "area"}, {"shape", "sphere"}, {"radius", 0.1}, {"center", {0, 2, 0}}};
    const Scene scene = load(Json::array(), {fleeting, area, point});
    SceneAnimator animator(scene);
    const SceneChanges& before = animator.advance(0);
    ASSERT_EQ(before.lights.size(), 2u);
    EXPECT_EQ(before.area_lights[0].number, 0u);
    EXPECT_EQ(before.lights[0].number, 1u);
    EXPECT_EQ(before.lights[1].number, 2u);
    const SceneChanges& after = animator.advance(from_seconds(1));
    ASSERT_EQ(after.lights.size(), 1u);
    EXPECT_EQ(after.lights[0].number, 2u);
    EXPECT_EQ(after.area_lights[0].number, 0u);
}

TEST_F(ChangingScene, MaterialsFollowTheirKeys) {
    const auto channel = [](const char* property, const Json& from, const Json& to) {
        return Json{{"property", property}, {"times", {0, 2}}, {"values", {from, to}}};
    };
    const Scene scene =
        load({{{"shape", "sphere"}},
              {{"shape", "sphere"},
               {"material",
                {{"base_color", {1, 1, 1}},
                 {"ior", 1.3},
                 {"animation",
                  {channel("base_color", {1, 0, 0}, {0, 1, 0}), channel("alpha", 1, 0.5),
                   channel("metallic", 0, 1), channel("roughness", 0.2, 0.4),
                   channel("emissive", {0, 0, 0}, {8, 4, 0}), channel("transmission", 0, 1)}}}}}});
    SceneAnimator animator(scene);
    EXPECT_TRUE(animator.advance(0).materials.at(0).changed);
    const SceneChanges& now = animator.advance(from_seconds(1));
    ASSERT_EQ(now.materials.size(), 1u);
    EXPECT_EQ(now.materials[0].material, scene.shapes[1].material);
    EXPECT_TRUE(now.materials[0].changed);
    const Material& m = now.materials[0].values;
    expect_near(vec3(m.base_color), {0.5f, 0.5f, 0});
    EXPECT_FLOAT_EQ(m.base_color.a, 0.75f);
    EXPECT_FLOAT_EQ(m.metallic, 0.5f);
    EXPECT_FLOAT_EQ(m.roughness, 0.3f);
    expect_near(m.emissive, {4, 2, 0});
    EXPECT_FLOAT_EQ(m.transmission, 0.5f);
    EXPECT_FLOAT_EQ(m.ior, 1.3f);
    EXPECT_FALSE(animator.advance(from_seconds(1)).materials[0].changed);
    // Structures are built for what it will be.
    EXPECT_EQ(scene.materials[scene.shapes[1].material].alpha_mode, AlphaMode::Blend);
    EXPECT_FALSE(is_opaque(scene.materials[scene.shapes[1].material]));
    EXPECT_TRUE(is_opaque(scene.materials[scene.shapes[0].material]));
}

TEST_F(ChangingScene, BadTimesAndPropertiesAreNamed) {
    expect_bad({{"shape", "sphere"}, {"present", {{2, 1}}}}, "/objects/0/present/0: ends before it starts");
    expect_bad({{"shape", "sphere"}, {"present", {{-1, 1}}}}, "/objects/0/present/0/0");
    expect_bad({{"shape", "sphere"}, {"present", Json::array()}}, "/objects/0/present");
    expect_bad({{"shape", "sphere"},
                {"material", {{"animation", {{{"property", "colour"}, {"times", {0}}, {"values", {1}}}}}}}},
               "/objects/0/material/animation/0/property");
    expect_bad(
        {{"shape", "sphere"},
         {"material", {{"animation", {{{"property", "roughness"}, {"times", {0}}, {"values", {2}}}}}}}},
        "out of range");
}

TEST_F(ChangingScene, FilesThatWereReadAreTold) {
    const std::string missing = "missing.glb";
    std::vector<std::filesystem::path> files;
    const Json json = {{"format", "foveray-scene"},
                       {"version", 1},
                       {"objects", {{{"shape", "sphere"}}}},
                       {"environment", {{"file", "sky.hdr"}}},
                       {"models", {{{"file", missing}}}}};
    const auto file = folder_.write("scene.json", json.dump());
    EXPECT_ANY_THROW(load_scene(file, &files));
    EXPECT_EQ(files, (std::vector<std::filesystem::path>{file, file.parent_path() / missing}));
}

}  // namespace
}  // namespace foveray::scene
