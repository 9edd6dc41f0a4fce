#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

using fakes::GltfBuilder;

class GltfNode : public GltfTest {
  protected:
    static std::vector<mat4> worlds(const Scene& scene) {
        SceneAnimator animator(scene);
        std::vector<mat4> out;
        for (const InstanceState& s : animator.advance(0).instances) out.push_back(s.world_from_object);
        return out;
    }
};

TEST_F(GltfNode, transformsMultiplyDownTheTree) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.json["nodes"] = Json::array();
    // Listed child first, to be sure that order in the file does not matter.
    gltf.add("nodes", {{"mesh", 0}, {"translation", {1, 0, 0}}, {"scale", {2, 2, 2}}});
    gltf.add("nodes",
             {{"children", {0}}, {"rotation", {0, 0.70710678, 0, 0.70710678}}, {"translation", {0, 5, 0}}});
    gltf.json["scenes"][0]["nodes"] = {1};
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.nodes.size(), 2u);
    EXPECT_EQ(scene.nodes[1].parent, std::optional<NodeId>(0));
    // (1, 0, 0) -> scale and move: (3, 0, 0) -> a quarter turn about y: (0, 0, -3) -> up 5.
    expect_near(transform(worlds(scene)[0], {1, 0, 0}), {0, 5, -3});
    expect_near(scene.bounds.min, {0, 5, -3});
}

TEST_F(GltfNode, aMeshThatAScaleOfZeroFlattensIsNamed) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.add_root({{"scale", {1, 1, 0}}, {"children", {2}}});
    gltf.add("nodes", {{"mesh", 0}});
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.instances.size(), 2u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("/nodes/2: its mesh is left out: /nodes/1's transform flattens it"),
              std::string::npos)
        << scene.warnings[0];
}

TEST_F(GltfNode, matricesAreColumnMajor) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.json["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    expect_near(transform(worlds(load(gltf))[0], {1, 0, 0}), {7, 6, 7});
}

TEST_F(GltfNode, sharedMeshesAreLoadedOnce) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.add_root({{"mesh", 0}, {"translation", {3, 0, 0}}});
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[1].mesh);
    expect_near(transform(worlds(scene)[1], {0, 0, 0}), {3, 0, 0});
}

TEST_F(GltfNode, gpuInstancing) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const int translations = gltf.add_accessor<float>({1, 0, 0, 0, 2, 0}, "VEC3");
    const int rotations = gltf.add_accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}, "VEC4", true);
    const int scales = gltf.add_accessor<float>({1, 1, 1, 2, 2, 2}, "VEC3");
    Json& node = gltf.json["nodes"][0];
    node["translation"] = {0, 0, -1};
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translations}, {"ROTATION", rotations}, {"SCALE", scales}};
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.instances.size(), 2u);
    const auto world = worlds(scene);
    expect_near(transform(world[0], {1, 0, 0}), {2, 0, -1});
    expect_near(transform(world[1], {1, 0, 0}), {-2, 2, -1});  // half a turn about z
}

TEST_F(GltfNode, punctualLights) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.json["extensionsRequired"] = {"KHR_lights_punctual"};
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"color", {1, 0.5, 0}}, {"intensity", 4}},
        {{"type", "point"}, {"range", 3}},
        {{"type", "spot"}, {"intensity", 2}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}};
    for (int light = 0; light < 3; ++light) {
        gltf.add_root({{"translation", {light, 2, 0}},
                       {"rotation", {-0.70710678, 0, 0, 0.70710678}},  // -z turns to -y
                       {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    }
    const Scene scene = load(gltf);
    SceneAnimator animator(scene);
    const auto& lights = animator.advance(0).lights;
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].kind, LightKind::Directional);
    expect_near(lights[0].intensity, {4, 2, 0});
    expect_near(lights[0].direction, {0, -1, 0});
    EXPECT_EQ(lights[1].kind, LightKind::Point);
    EXPECT_EQ(lights[1].range, 3.0f);
    expect_near(lights[1].position, {1, 2, 0});
    EXPECT_EQ(lights[2].kind, LightKind::Spot);
    EXPECT_FLOAT_EQ(lights[2].cos_inner_cone, std::cos(0.1f));
    EXPECT_FLOAT_EQ(lights[2].cos_outer_cone, std::cos(0.2f));
    EXPECT_EQ(lights[2].range, 0.0f);
}

TEST_F(GltfNode, perspectiveCamerasAreKeptAndOrthographicOnesNot) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.add("cameras",
             {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}, {"aspectRatio", 2}}}});
    gltf.add("cameras", {{"type", "orthographic"},
                         {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 10}, {"znear", 0.1}}}});
    gltf.add_root({{"camera", 0}});
    gltf.add_root({{"camera", 1}});
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_FLOAT_EQ(scene.cameras[0].vertical_fov, 0.8f);
    EXPECT_FLOAT_EQ(scene.cameras[0].aspect_ratio, 2.0f);
    EXPECT_EQ(scene.nodes[1].camera, std::optional<CameraId>(0));
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST_F(GltfNode, sceneOfTheFileCanBeChosen) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.add("nodes", {{"name", "other"}});
    gltf.add("scenes", {{"nodes", {1}}});
    EXPECT_EQ(load(gltf).instances.size(), 1u);
    GltfModel::Use use;
    use.scene = 1;
    const Scene other = load(gltf, use);
    EXPECT_EQ(other.instances.size(), 0u);
    EXPECT_EQ(other.nodes[0].name, "other");
}

TEST_F(GltfNode, binaryFilesAreTheSame) {
    GltfBuilder gltf = GltfBuilder::triangle();
    const Scene scene = load_file(folder_.write("model.glb", gltf.binary()));
    EXPECT_EQ(scene.meshes[0].primitives[0].positions, load(gltf).meshes[0].primitives[0].positions);
}

TEST_F(GltfNode, buffersInFilesOfTheirOwn) {
    GltfBuilder gltf = GltfBuilder::triangle();
    Json json = gltf.json;
    json["buffers"] = Json::array({{{"byteLength", gltf.bytes.size()}, {"uri", "data/points.bin"}}});
    folder_.write("data/points.bin", std::string(gltf.bytes.begin(), gltf.bytes.end()));
    EXPECT_EQ(load_file(folder_.write("model.gltf", json.dump())).instances.size(), 1u);
}

class GltfSkin : public GltfTest {
  protected:
    /// The triangle hangs on joint 0 (vertices 0, 1) and joint 1 (vertex 2); joints start at y = 0 and y = 1.
    static GltfBuilder skinned() {
        GltfBuilder gltf = GltfBuilder::triangle();
        Json& attributes = gltf.primitive()["attributes"];
        attributes["JOINTS_0"] =
            gltf.add_accessor<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
        attributes["WEIGHTS_0"] =
            gltf.add_accessor<std::uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}, "VEC4", true);
        const int inverse_bind = gltf.add_accessor<float>(
            {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1},
            "MAT4");
        gltf.json["nodes"][0]["skin"] = 0;
        gltf.json["nodes"][0]["translation"] = {100, 0, 0};  // a skinned mesh's own transform has no effect
        gltf.add_root({{"children", {2}}});
        gltf.add("nodes", {{"translation", {0, 1, 0}}});
        gltf.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", inverse_bind}});
        return gltf;
    }
};

TEST_F(GltfSkin, restPoseIsTheBindPose) {
    const Scene scene = load(skinned());
    ASSERT_EQ(scene.skins.size(), 1u);
    ASSERT_EQ(scene.deformations.size(), 1u);
    EXPECT_EQ(scene.instances[0].deformation, std::optional<DeformationId>(0));
    expect_near(scene.bounds.min, {0, 0, 0});
    expect_near(scene.bounds.max, {1, 1, 0});
    SceneAnimator animator(scene);
    const SceneChanges& start = animator.advance(0);
    EXPECT_EQ(start.instances[0].world_from_object, mat4(1.0f));
    EXPECT_EQ(start.deformations[0].joints, std::vector<mat4>(2, mat4(1.0f)));
}

TEST_F(GltfSkin, aParentMovesTheWholeSkin) {
    GltfBuilder gltf = skinned();
    SceneBuilder builder;
    Node root;
    root.local.translation = {0, 0, -4};
    root.local.scale = vec3(2);
    GltfModel::Use use;
    use.parent = builder.add(root);
    GltfModel(builder, folder_.write("model.gltf", gltf.text())).instantiate(use);
    const Scene scene = std::move(builder).build();
    expect_near(scene.bounds.min, {0, 0, -4});
    expect_near(scene.bounds.max, {2, 2, -4});
}

}  // namespace
}  // namespace foveray::scene
