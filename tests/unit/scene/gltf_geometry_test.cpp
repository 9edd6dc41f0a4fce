#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

using fakes::GltfBuilder;
using Indices = std::vector<std::uint32_t>;

class GltfGeometry : public GltfTest {
  protected:
    /// Five points on a line of triangles: (0,0) (1,0) (0,1) (1,1) (0,2), with normals so that vertices stay
    /// shared.
    static GltfBuilder five_points() {
        GltfBuilder gltf;
        const int positions = gltf.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3");
        const int normals = gltf.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        gltf.add_root(
            {{"mesh", gltf.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}})}});
        return gltf;
    }
};

TEST_F(GltfGeometry, trianglesWithoutIndices) {
    GltfBuilder gltf = GltfBuilder::triangle();
    const Primitive p = load_primitive(gltf);
    EXPECT_EQ(p.indices, (Indices{0, 1, 2}));
    expect_near(p.positions[1], {1, 0, 0});
}

TEST_F(GltfGeometry, indicesOf8And16And32Bits) {
    GltfBuilder small = five_points(), medium = five_points(), large = five_points();
    small.primitive()["indices"] = small.add_accessor<std::uint8_t>({0, 1, 2, 2, 1, 3}, "SCALAR");
    medium.primitive()["indices"] = medium.add_accessor<std::uint16_t>({0, 1, 2, 2, 1, 3}, "SCALAR");
    large.primitive()["indices"] = large.add_accessor<std::uint32_t>({0, 1, 2, 2, 1, 3}, "SCALAR");
    for (const GltfBuilder& gltf : {small, medium, large}) {
        EXPECT_EQ(load_primitive(gltf).indices, (Indices{0, 1, 2, 2, 1, 3}));
    }
}

TEST_F(GltfGeometry, stripsKeepTheirWinding) {
    GltfBuilder gltf = five_points();
    gltf.primitive()["mode"] = 5;
    const Primitive p = load_primitive(gltf);
    EXPECT_EQ(p.indices, (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    for (std::size_t t = 0; t < p.indices.size(); t += 3) {
        const vec3 a = p.positions[p.indices[t]], b = p.positions[p.indices[t + 1]],
                   c = p.positions[p.indices[t + 2]];
        EXPECT_GT(glm::cross(b - a, c - a).z, 0.0f);
    }
}

TEST_F(GltfGeometry, fans) {
    GltfBuilder gltf = five_points();
    gltf.primitive()["mode"] = 6;
    gltf.primitive()["indices"] = gltf.add_accessor<std::uint16_t>({0, 1, 3, 4}, "SCALAR");
    EXPECT_EQ(load_primitive(gltf).indices, (Indices{1, 3, 0, 3, 4, 0}));
}

TEST_F(GltfGeometry, pointsAndLinesAreSkippedWithOneWarning) {
    GltfBuilder gltf = GltfBuilder::triangle();
    const Json attributes = gltf.primitive()["attributes"];
    for (int mode = 0; mode < 4; ++mode) {
        gltf.json["meshes"][0]["primitives"].push_back({{"attributes", attributes}, {"mode", mode}});
    }
    const int lines = gltf.add_mesh({{"attributes", attributes}, {"mode", 1}});
    gltf.add_root({{"mesh", lines}});
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].primitives.size(), 1u);
    EXPECT_EQ(scene.instances.size(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("5 primitive(s) of points or lines"), std::string::npos);
}

TEST_F(GltfGeometry, missingNormalsAreFlat) {
    GltfBuilder gltf;
    // Two triangles with a shared edge, at a right angle.
    const int positions = gltf.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1}, "VEC3");
    const int indices = gltf.add_accessor<std::uint8_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    gltf.add_root(
        {{"mesh", gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
    const Primitive p = load_primitive(gltf);
    ASSERT_EQ(p.positions.size(), 6u);
    EXPECT_EQ(p.indices, (Indices{0, 1, 2, 3, 4, 5}));
    for (int i = 0; i < 3; ++i) expect_near(p.normals[static_cast<std::size_t>(i)], {0, 0, 1});
    for (int i = 3; i < 6; ++i) expect_near(p.normals[static_cast<std::size_t>(i)], {-1, 0, 0});
}

TEST_F(GltfGeometry, normalsAreMadeUnit) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.primitive()["attributes"]["NORMAL"] = gltf.add_accessor<float>({0, 0, 2, 0, 3, 0, 0, 0, 0}, "VEC3");
    const Primitive p = load_primitive(gltf);
    expect_near(p.normals[0], {0, 0, 1});
    expect_near(p.normals[1], {0, 1, 0});
    EXPECT_NEAR(glm::length(p.normals[2]), 1.0f, 1e-6f);
}

TEST_F(GltfGeometry, sparseAccessorsReplaceElements) {
    GltfBuilder gltf = five_points();
    const int indices = gltf.add_view<std::uint16_t>({1, 3});
    const int values = gltf.add_view<float>({7, 8, 9, 4, 5, 6});
    gltf.json["accessors"][0]["sparse"] = {{"count", 2},
                                           {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                           {"values", {{"bufferView", values}}}};
    const Primitive p = load_primitive(gltf);
    expect_near(p.positions[0], {0, 0, 0});
    expect_near(p.positions[1], {7, 8, 9});
    expect_near(p.positions[3], {4, 5, 6});
}

TEST_F(GltfGeometry, sparseAccessorsWithoutViewStartFromZeros) {
    GltfBuilder gltf = five_points();
    const int indices = gltf.add_view<std::uint8_t>({1, 2});
    const int values = gltf.add_view<float>({1, 0, 0, 0, 1, 0});
    Json& accessor = gltf.json["accessors"][0];
    accessor.erase("bufferView");
    accessor["sparse"] = {{"count", 2},
                          {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                          {"values", {{"bufferView", values}}}};
    const Primitive p = load_primitive(gltf);
    expect_near(p.positions[2], {0, 1, 0});
    expect_near(p.positions[4], {0, 0, 0});
}

TEST_F(GltfGeometry, stridesAndOffsets) {
    GltfBuilder gltf = GltfBuilder::triangle();
    // Position and texture coordinate interleaved: 20 bytes a vertex.
    const int view = gltf.add_view<float>({0, 0, 0, .1f, .2f, 2, 0, 0, .3f, .4f, 0, 2, 0, .5f, .6f});
    gltf.json["bufferViews"][view]["byteStride"] = 20;
    const Json base = {{"bufferView", view}, {"componentType", 5126}, {"count", 3}};
    Json positions = base, uv = base;
    positions["type"] = "VEC3";
    uv["type"] = "VEC2", uv["byteOffset"] = 12;
    gltf.primitive()["attributes"] = {{"POSITION", gltf.add("accessors", positions)},
                                      {"TEXCOORD_0", gltf.add("accessors", uv)}};
    const Primitive p = load_primitive(gltf);
    expect_near(p.positions[2], {0, 2, 0});
    EXPECT_FLOAT_EQ(p.uv0[1].x, 0.3f);
    EXPECT_FLOAT_EQ(p.uv0[2].y, 0.6f);
}

TEST_F(GltfGeometry, normalisedIntegersMapToTheirRange) {
    GltfBuilder gltf = GltfBuilder::triangle();
    Json& attributes = gltf.primitive()["attributes"];
    attributes["TEXCOORD_0"] =
        gltf.add_accessor<std::uint16_t>({0, 65535, 32768, 0, 65535, 65535}, "VEC2", true);
    attributes["TEXCOORD_1"] = gltf.add_accessor<std::uint8_t>({0, 255, 51, 0, 255, 255}, "VEC2", true);
    attributes["COLOR_0"] =
        gltf.add_accessor<std::uint8_t>({255, 0, 51, 255, 0, 255, 0, 102, 0, 0, 255, 0}, "VEC4", true);
    const Primitive p = load_primitive(gltf);
    EXPECT_FLOAT_EQ(p.uv0[0].y, 1.0f);
    EXPECT_NEAR(p.uv0[1].x, 32768.0f / 65535.0f, 1e-6f);
    EXPECT_FLOAT_EQ(p.uv1[1].x, 0.2f);
    EXPECT_FLOAT_EQ(p.colors[0].b, 0.2f);
    EXPECT_FLOAT_EQ(p.colors[1].a, 0.4f);
}

TEST_F(GltfGeometry, colorsOfThreeComponentsAreOpaque) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.primitive()["attributes"]["COLOR_0"] = gltf.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    const Primitive p = load_primitive(gltf);
    EXPECT_EQ(p.colors[1], vec4(0, 1, 0, 1));
}

TEST_F(GltfGeometry, meshQuantization) {
    GltfBuilder gltf;
    gltf.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const int positions = gltf.add_accessor<std::int16_t>({0, 0, 0, 0, 100, 0, -50, 0, 0, 200, 0, 0}, "VEC3");
    gltf.json["accessors"][positions]["count"] = 3;
    gltf.json["bufferViews"][0]["byteStride"] = 8;
    const int normals =
        gltf.add_accessor<std::int8_t>({0, 0, 127, 0, 0, 0, -128, 0, 0, 127, 0, 0}, "VEC3", true);
    gltf.json["accessors"][normals]["count"] = 3;
    gltf.json["bufferViews"][1]["byteStride"] = 4;
    const int uv = gltf.add_accessor<std::int16_t>({-32768, 32767, -32767, 0, 0, 0}, "VEC2", true);
    const Json attributes = {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv}};
    gltf.add_root({{"mesh", gltf.add_mesh({{"attributes", attributes}})}});
    const Primitive p = load_primitive(gltf);
    EXPECT_EQ(p.uv0[0], vec2(-1, 1));  // the lowest integer is -1 too
    EXPECT_EQ(p.uv0[1], vec2(-1, 0));
    expect_near(p.positions[1], {100, 0, -50});
    expect_near(p.positions[2], {0, 200, 0});
    expect_near(p.normals[0], {0, 0, 1});
    expect_near(p.normals[1], {0, 0, -1});
}

TEST_F(GltfGeometry, boundsCoverAllPrimitives) {
    const Scene scene = load(five_points());
    expect_near(scene.meshes[0].bounds.min, {0, 0, 0});
    expect_near(scene.meshes[0].bounds.max, {1, 2, 0});
}

TEST_F(GltfGeometry, morphTargetsAreRead) {
    GltfBuilder gltf = five_points();
    const int deltas = gltf.add_accessor<float>({0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 5}, "VEC3");
    gltf.primitive()["targets"] = Json::array({{{"POSITION", deltas}}, {{"NORMAL", deltas}}});
    gltf.json["meshes"][0]["weights"] = {0.25, 0.5};
    const Scene scene = load(gltf);
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.primitives[0].morph_targets.size(), 2u);
    expect_near(mesh.primitives[0].morph_targets[0].positions[4], {0, 0, 5});
    EXPECT_TRUE(mesh.primitives[0].morph_targets[0].normals.empty());
    EXPECT_EQ(mesh.morph_weights, (std::vector<float>{0.25f, 0.5f}));
    ASSERT_EQ(scene.deformations.size(), 1u);
    EXPECT_FALSE(scene.deformations[0].animated);
}

}  // namespace
}  // namespace foveray::scene
