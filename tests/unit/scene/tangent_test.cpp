#include "render/scene/complete_mesh.h"
#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

/// A quad in the xy plane facing +z, its picture upright: u to +x, v downwards.
Primitive quad() {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    p.normals.assign(4, {0, 0, 1});
    p.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    p.indices = {0, 1, 2, 0, 2, 3};
    return p;
}

vec3 bitangent(const Primitive& p, std::size_t i) {
    return p.tangents[i].w * glm::cross(p.normals[i], vec3(p.tangents[i]));
}

TEST(Tangents, pointAlongUAndTheBitangentUpInThePicture) {
    Primitive p = quad();
    make_tangents(p, {});
    ASSERT_EQ(p.tangents.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        expect_near(vec3(p.tangents[i]), {1, 0, 0});
        expect_near(bitangent(p, i), {0, 1, 0});
    }
}

TEST(Tangents, followTheTextureTransform) {
    Primitive p = quad();
    TextureUse use;
    use.rotation = pi / 2;  // u' = v, v' = -u: u' grows downwards, the picture's up is +x
    make_tangents(p, use);
    expect_near(vec3(p.tangents[0]), {0, -1, 0});
    expect_near(bitangent(p, 0), {1, 0, 0});
}

TEST(Tangents, mirroredTextureCoordinatesSplitVertices) {
    Primitive p = quad();
    p.positions.insert(p.positions.end(), {{-1, 0, 0}, {-1, 1, 0}});
    p.normals.assign(6, {0, 0, 1});
    p.uv0.insert(p.uv0.end(), {{1, 1}, {1, 0}});  // mirrored at x = 0
    p.indices.insert(p.indices.end(), {4, 0, 3, 4, 3, 5});
    p.colors.assign(6, vec4(0.5f));
    make_tangents(p, {});
    EXPECT_EQ(p.positions.size(), 8u);  // the two vertices at x = 0 have twins
    EXPECT_EQ(p.colors.size(), 8u);
    for (std::size_t i = 0; i < p.indices.size(); ++i) {
        const bool mirrored = i >= 6;
        const std::uint32_t v = p.indices[i];
        expect_near(vec3(p.tangents[v]), {mirrored ? -1.0f : 1.0f, 0, 0});
        expect_near(bitangent(p, v), {0, 1, 0});
    }
    for (std::size_t t = 0; t < p.indices.size(); t += 3) {  // the surface is still the same
        const vec3 a = p.positions[p.indices[t]], b = p.positions[p.indices[t + 1]],
                   c = p.positions[p.indices[t + 2]];
        EXPECT_NEAR(glm::cross(b - a, c - a).z, 1.0f, 1e-6f);
    }
}

TEST(Tangents, arePerpendicularToBentNormalsAndUnit) {
    Mesh sphere = make_sphere(2.0f, 16);
    Primitive& p = sphere.primitives[0];
    make_tangents(p, {});
    for (std::size_t i = 0; i < p.tangents.size(); ++i) {
        EXPECT_NEAR(glm::length(vec3(p.tangents[i])), 1.0f, 1e-5f);
        EXPECT_NEAR(glm::dot(vec3(p.tangents[i]), p.normals[i]), 0.0f, 1e-5f);
        const bool at_seam = p.uv0[i].x == 0.0f || p.uv0[i].x == 1.0f;  // triangles on one side only
        if (at_seam || std::abs(p.normals[i].y) > 0.95f) continue;
        expect_near(vec3(p.tangents[i]), glm::normalize(glm::cross(vec3(0, 1, 0), p.normals[i])), 0.02f);
    }
}

TEST(Tangents, withoutTextureCoordinatesAreStillUnit) {
    Primitive p = quad();
    p.uv0.clear();
    make_tangents(p, {});
    EXPECT_NEAR(glm::length(vec3(p.tangents[0])), 1.0f, 1e-6f);
    EXPECT_NEAR(p.tangents[0].z, 0.0f, 1e-6f);
}

class GltfTangents : public GltfTest {};

TEST_F(GltfTangents, areMadeOnlyWhereANormalTextureNeedsThem) {
    fakes::GltfBuilder gltf = fakes::GltfBuilder::triangle();
    Json& attributes = gltf.primitive()["attributes"];
    attributes["NORMAL"] = gltf.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    attributes["TEXCOORD_0"] = gltf.add_accessor<float>({0, 1, 1, 1, 0, 0}, "VEC2");
    EXPECT_TRUE(load_primitive(gltf).tangents.empty());
    Image image(1, 1, 4);
    gltf.add("textures", {{"source", gltf.add_image(image)}});
    gltf.primitive()["material"] = gltf.add("materials", {{"normalTexture", {{"index", 0}}}});
    const Primitive made = load_primitive(gltf);
    ASSERT_EQ(made.tangents.size(), 3u);
    expect_near(vec3(made.tangents[0]), {1, 0, 0});
    gltf.primitive()["attributes"]["TANGENT"] =
        gltf.add_accessor<float>({0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}, "VEC4");
    const Primitive given = load_primitive(gltf);
    EXPECT_EQ(given.tangents[0], vec4(0, 1, 0, -1));
}

}  // namespace
}  // namespace foveray::scene
