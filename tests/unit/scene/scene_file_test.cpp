#include "render/scene/scene_file.h"

#include <cmath>
#include <fstream>

#include "render/scene/load_scene.h"
#include "tests/fakes/expect_fault.h"
#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

class SceneFile : public GltfTest {
  protected:
    SceneFile() { folder_.write("models/triangle.gltf", fakes::GltfBuilder::triangle().text()); }

    Scene load_json(Json json) {
        json["format"] = "foveray-scene";
        json["version"] = 1;
        return load_scene(folder_.write("scene.json", json.dump()));
    }
    SceneChanges start_of(const Scene& scene) {
        SceneAnimator animator(scene);
        return animator.advance(0);
    }
    void expect_bad(const Json& json, const std::string& part) {
        fakes::expect_fault([&] { load_json(json); }, ExitCode::BadInput, part);
    }
};

TEST_F(SceneFile, anEmptySceneHasADefaultSky) {
    const Scene scene = load_json(Json::object());
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_TRUE(scene.bounds.empty());
    EXPECT_FALSE(scene.environment.radiance.empty());
}

TEST_F(SceneFile, modelsArePlacedAndShareTheirFile) {
    const Scene scene = load_json(
        {{"models",
          {{{"file", "models/triangle.gltf"},
            {"name", "first"},
            {"transform", {{"translation", {1, 2, 3}}, {"euler_degrees", {0, 90, 0}}, {"scale", {2, 2, 2}}}}},
           {{"file", "models/triangle.gltf"}, {"transform", {{"rotation", {0, 0, 1, 0}}}}}}}});
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.nodes[0].name, "first");
    const SceneChanges start = start_of(scene);
    expect_near(transform(start.instances[0].world_from_object, {1, 0, 0}), {1, 2, 1});
    expect_near(transform(start.instances[1].world_from_object, {1, 0, 0}), {-1, 0, 0});
}

TEST_F(SceneFile, eulerAnglesRollThenPitchThenYaw) {
    const Scene scene = load_json(
        {{"models", {{{"file", "models/triangle.gltf"}, {"transform", {{"euler_degrees", {90, 90, 90}}}}}}}});
    // Roll takes x to y, pitch y to z, yaw z to x.
    expect_near(transform(start_of(scene).instances[0].world_from_object, {1, 0, 0}), {1, 0, 0});
}

TEST_F(SceneFile, lightsOfEveryKind) {
    const Scene scene = load_json({{"lights",
                                    {{{"type", "directional"}, {"direction", {0, -2, 0}}, {"intensity", 3}},
                                     {{"type", "point"},
                                      {"position", {1, 2, 3}},
                                      {"color", {1, 0.5, 0}},
                                      {"intensity", 2},
                                      {"range", 5}},
                                     {{"type", "spot"},
                                      {"position", {0, 1, 0}},
                                      {"direction", {1, 0, 0}},
                                      {"inner_cone_degrees", 10},
                                      {"outer_cone_degrees", 20}},
                                     {{"type", "area"},
                                      {"center", {0, 3, 0}},
                                      {"half_u", {0.5, 0, 0}},
                                      {"half_v", {0, 0, 0.25}},
                                      {"intensity", 8}}}}});
    const SceneChanges start = start_of(scene);
    ASSERT_EQ(start.lights.size(), 3u);
    EXPECT_EQ(start.lights[0].kind, LightKind::Directional);
    expect_near(start.lights[0].direction, {0, -1, 0});
    expect_near(start.lights[0].intensity, vec3(3));
    EXPECT_EQ(start.lights[1].kind, LightKind::Point);
    expect_near(start.lights[1].position, {1, 2, 3});
    expect_near(start.lights[1].intensity, {2, 1, 0});
    EXPECT_EQ(start.lights[1].range, 5.0f);
    EXPECT_EQ(start.lights[2].kind, LightKind::Spot);
    expect_near(start.lights[2].direction, {1, 0, 0});
    EXPECT_NEAR(start.lights[2].cos_inner_cone, std::cos(radians(10)), 1e-6f);
    EXPECT_NEAR(start.lights[2].cos_outer_cone, std::cos(radians(20)), 1e-6f);
    ASSERT_EQ(start.area_lights.size(), 1u);
    expect_near(start.area_lights[0].center, {0, 3, 0});
    expect_near(start.area_lights[0].half_u, {0.5f, 0, 0});
    expect_near(start.area_lights[0].half_v, {0, 0, 0.25f});
    expect_near(glm::normalize(glm::cross(start.area_lights[0].half_u, start.area_lights[0].half_v)),
                {0, -1, 0});
    expect_near(start.area_lights[0].radiance, vec3(8));
}

TEST_F(SceneFile, environmentColor) {
    const Scene scene = load_json({{"environment", {{"color", {0.1, 0.2, 0.3}}, {"intensity", 2}}}});
    EXPECT_EQ(scene.environment.radiance.pixels, (std::vector<float>{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(scene.environment.intensity, 2.0f);
}

TEST_F(SceneFile, environmentPicture) {
    // 2 x 1 pixels of Radiance RGBE: 1.0 = 128 / 256 * 2^(129 - 128).
    const std::string rgbe{"\x80\x40\x20\x81\x80\x80\x80\x82", 8};
    folder_.write("sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + rgbe);
    const Scene scene = load_json({{"environment", {{"file", "sky.hdr"}, {"rotation_degrees", 90}}}});
    ASSERT_EQ(scene.environment.radiance.width, 2u);
    EXPECT_NEAR(scene.environment.radiance.at(0, 0)[0], 1.0f, 0.01f);
    EXPECT_NEAR(scene.environment.radiance.at(0, 0)[2], 0.25f, 0.01f);
    EXPECT_NEAR(scene.environment.radiance.at(1, 0)[0], 2.0f, 0.02f);
    EXPECT_NEAR(scene.environment.rotation, pi / 2, 1e-6f);
}

TEST_F(SceneFile, planes) {
    const Scene scene = load_json({{"real_surfaces",
                                    {{{"type", "plane"},
                                      {"name", "wall"},
                                      {"center", {0, 1, -2}},
                                      {"normal", {0, 0, 1}},
                                      {"half_size", {3, 0.5}},
                                      {"reflectance", 0.04},
                                      {"roughness", 0.1},
                                      {"albedo", {0.2, 0.3, 0.4}}}}}});
    ASSERT_EQ(scene.real_surfaces.size(), 1u);
    const RealSurface& wall = scene.real_surfaces[0];
    EXPECT_EQ(wall.name, "wall");
    EXPECT_EQ(wall.reflectance, 0.04f);
    EXPECT_EQ(wall.roughness, 0.1f);
    expect_near(wall.albedo, {0.2f, 0.3f, 0.4f});
    Aabb bounds;
    for (const vec3 p : scene.meshes[wall.mesh].primitives[0].positions)
        bounds.add(transform(wall.stage_from_object, p));
    expect_near(bounds.min, {-3, 0.5f, -2});
    expect_near(bounds.max, {3, 1.5f, -2});
    expect_near(vec3(wall.stage_from_object * vec4(0, 1, 0, 0)), {0, 0, 1});
    EXPECT_NEAR(glm::determinant(glm::mat3(wall.stage_from_object)), 1.0f, 1e-6f);
    EXPECT_TRUE(scene.instances.empty());
}

TEST_F(SceneFile, boxesAndMeshes) {
    const Scene scene =
        load_json({{"real_surfaces",
                    {{{"type", "box"}, {"pose", {{"position", {1, 0.4, 0}}}}, {"half_size", {0.5, 0.4, 0.3}}},
                     {{"type", "mesh"},
                      {"file", "models/triangle.gltf"},
                      {"transform", {{"translation", {0, 0, -1}}}}}}}});
    ASSERT_EQ(scene.real_surfaces.size(), 2u);
    expect_near(scene.meshes[scene.real_surfaces[0].mesh].bounds.max, {0.5f, 0.4f, 0.3f});
    expect_near(vec3(scene.real_surfaces[0].stage_from_object[3]), {1, 0.4f, 0});
    const Primitive& triangle = scene.meshes[scene.real_surfaces[1].mesh].primitives[0];
    EXPECT_EQ(triangle.indices.size(), 3u);
    expect_near(transform(scene.real_surfaces[1].stage_from_object, triangle.positions[1]), {1, 0, -1});
    EXPECT_EQ(scene.real_surfaces[0].reflectance, 0.0f);
    expect_near(scene.real_surfaces[0].albedo, vec3(0.5f));
}

TEST_F(SceneFile, worldFromStageAndCamera) {
    const Scene scene =
        load_json({{"world_from_stage", {{"position", {5, 0, 1}}, {"orientation", {0, 1, 0, 0}}}},
                   {"camera", {{"position", {0, 1, 2}}, {"look_at", {0, 1, 0}}}}});
    expect_near(transform_point(scene.world_from_stage, {1, 0, 0}), {4, 0, 1});
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_NEAR(scene.cameras[0].vertical_fov, radians(50.0f), 1e-6f);
    const SceneChanges start = start_of(scene);
    expect_near(transform(start.world_from_node[0], {0, 0, -2}), {0, 1, 0});
}

TEST_F(SceneFile, mistakesAreNamedWithTheirPlace) {
    const Json plane = {
        {"type", "plane"}, {"center", {0, 0, 0}}, {"normal", {0, 1, 0}}, {"half_size", {1, 1}}};
    const auto plane_with = [&](const char* key, const Json& value) {
        Json p = plane;
        p[key] = value;
        return Json{{"real_surfaces", {p}}};
    };
    expect_bad({{"modles", Json::array()}}, "modles");
    expect_bad({{"models", {{{"name", "x"}}}}}, "/models/0");
    expect_bad({{"models", {{{"file", "models/triangle.gltf"}, {"colour", 1}}}}}, "/models/0");
    expect_bad({{"models", {{{"file", "models/none.gltf"}}}}}, "none.gltf");
    expect_bad({{"models", {{{"file", "models/triangle.gltf"}, {"scene", 3}}}}}, "scene 3 is asked for");
    expect_bad({{"models", {{{"file", "models/triangle.gltf"}, {"transform", {{"scale", {1, 0, 1}}}}}}}},
               "/models/0/transform/scale/1");
    expect_bad({{"models",
                 {{{"file", "models/triangle.gltf"},
                   {"transform", {{"rotation", {0, 0, 0, 1}}, {"euler_degrees", {0, 0, 0}}}}}}}},
               "/models/0/transform: gives the rotation twice");
    expect_bad({{"lights", {{{"type", "laser"}}}}}, "/lights/0/type");
    expect_bad({{"lights", {{{"type", "directional"}, {"direction", {0, 0}}}}}}, "/lights/0/direction");
    expect_bad({{"lights", {{{"type", "directional"}, {"direction", {0, 0, 0}}}}}}, "/lights/0/direction");
    expect_bad({{"lights", {{{"type", "directional"}, {"direction", {0, -1, 0}}, {"range", 1}}}}},
               "/lights/0");
    expect_bad({{"lights",
                 {{{"type", "area"}, {"center", {0, 1, 0}}, {"half_u", {1, 0, 0}}, {"half_v", {2, 0, 0}}}}}},
               "/lights/0: has no area");
    expect_bad({{"environment", {{"file", "none.hdr"}}}}, "none.hdr");
    expect_bad({{"environment", {{"file", "models/triangle.gltf"}}}}, "triangle.gltf");
    expect_bad(plane_with("half_size", {1, -1}), "/real_surfaces/0/half_size/1");
    expect_bad(plane_with("reflectance", 2), "/real_surfaces/0/reflectance");
    expect_bad(plane_with("normal", {0, 0, 0}), "/real_surfaces/0/normal");
    expect_bad(plane_with("u_axis", {0, 3, 0}), "/real_surfaces/0/u_axis");
    expect_bad({{"world_from_stage", {{"orientation", {0, 0, 0, 0}}}}}, "/world_from_stage/orientation");
    expect_bad({{"camera", {{"position", {0, 0, 0}}, {"look_at", {0, 0, 0}}}}}, "/camera");
}

TEST_F(SceneFile, probesArePlacedOrFitted) {
    EXPECT_FALSE(load_json(Json::object()).probes);
    const Scene placed =
        load_json({{"probes", {{"counts", {4, 2, 3}}, {"center", {1, 2, 3}}, {"size", {2, 4, 6}}}}});
    ASSERT_TRUE(placed.probes);
    EXPECT_EQ(placed.probes->counts, uvec3(4, 2, 3));
    expect_near(placed.probes->min, {0, 0, 0});
    expect_near(placed.probes->max, {2, 4, 6});

    // A flat thing has room above it.
    const Json plane = {{{"shape", "plane"}, {"parameters", {{"half_size", {1, 2}}}}}};
    const Scene fitted = load_json({{"objects", plane}, {"probes", Json::object()}});
    ASSERT_TRUE(fitted.probes);
    EXPECT_EQ(fitted.probes->counts, uvec3(16, 8, 16));
    EXPECT_NEAR(fitted.probes->min.x, -1.0f, 1e-2f);
    EXPECT_NEAR(fitted.probes->max.z, 2.0f, 1e-2f);
    EXPECT_GT(fitted.probes->max.y, 0.05f);
}

TEST_F(SceneFile, badProbes) {
    const auto probes = [](const Json& value) { return Json{{"probes", value}}; };
    expect_bad(probes(Json::object()), "/probes: has nothing in the scene");
    expect_bad(probes({{"counts", {0, 2, 2}}}), "/probes/counts/0");
    expect_bad(probes({{"counts", {65, 2, 2}}}), "/probes/counts/0");
    expect_bad(probes({{"counts", {2, 2}}}), "/probes/counts");
    expect_bad(probes({{"counts", {2.5, 2, 2}}}), "/probes/counts/0");
    expect_bad(probes({{"counts", {64, 64, 64}}, {"center", {0, 0, 0}}, {"size", {1, 1, 1}}}),
               "/probes/counts: makes 262144 probes");
    expect_bad(probes({{"size", {1, 1, 1}}}), "/probes: has only one of center and size");
    expect_bad(probes({{"center", {0, 0, 0}}, {"size", {1, 0, 1}}}), "/probes/size/1");
    expect_bad(probes({{"center", {0, 0, 0}}, {"size", {1, 1e39, 1}}}), "/probes/size");
    expect_bad(probes({{"center", {0, 0, 0}}, {"size", {1, 1e-6, 1}}}), "/probes/size: is too small");
}

TEST_F(SceneFile, otherFormatsVersionsAndSyntax) {
    const auto expect_bad_text = [&](const std::string& text, const std::string& part) {
        fakes::expect_fault([&] { load_scene(folder_.write("scene.json", text)); }, ExitCode::BadInput, part);
    };
    expect_bad_text(R"({"format": "foveray-session", "version": 1})", "/format");
    expect_bad_text(R"({"format": "foveray-scene", "version": 2})", "/version");
    expect_bad_text(R"({"version": 1})", "format");
    expect_bad_text("{\n\n\"format\" 3}", "scene.json:3");
    expect_bad_text(
        "{\n\"format\": \"foveray-scene\", \"version\": 1,\n\"environment\": {\"intensity\": 1e400}}",
        "scene.json:3: 1e400 is too large a number");
    expect_bad_text("{\n\"version\": Infinity}", "scene.json:2: Infinity is no number in JSON");
    expect_bad_text("{\n\"version\": -Infinity}", "scene.json:2: Infinity is no number in JSON");
    expect_bad_text("{\n\"version\": NaN}", "scene.json:2: NaN is no number in JSON");
    expect_bad_text(R"({"format": "foveray-scene", "version": 1, "environment": {"intensity": 1e300}})",
                    "/environment/intensity");
    fakes::expect_fault([&] { load_scene(folder_.path() / "none.json"); }, ExitCode::BadInput, "none.json");
}

}  // namespace
}  // namespace foveray::scene
