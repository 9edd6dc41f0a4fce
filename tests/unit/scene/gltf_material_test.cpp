#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

using fakes::GltfBuilder;

Image two_by_one() {
    Image image(2, 1, 4);
    image.pixels = {255, 0, 0, 255, 0, 255, 0, 128};
    return image;
}

class GltfMaterial : public GltfTest {
  protected:
    Scene load_with(const Json& material) {
        GltfBuilder gltf = GltfBuilder::triangle();
        gltf.primitive()["material"] = gltf.add("materials", material);
        return load(gltf);
    }
    Material material_of(const Scene& scene) {
        return scene.materials[scene.meshes[0].primitives[0].material];
    }
};

TEST_F(GltfMaterial, defaultsAreThoseOfGltf) {
    const Scene scene = load(GltfBuilder::triangle());
    const Material m = material_of(scene);
    EXPECT_EQ(scene.meshes[0].primitives[0].material, 0u);
    EXPECT_EQ(m.base_color, vec4(1));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.emissive, vec3(0));
    EXPECT_EQ(m.alpha_mode, AlphaMode::Opaque);
    EXPECT_FALSE(m.double_sided);
    EXPECT_FALSE(m.base_color_texture);
}

TEST_F(GltfMaterial, factors) {
    const Scene scene = load_with(
        {{"name", "paint"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
         {"emissiveFactor", {0.5, 1, 0}},
         {"doubleSided", true}});
    const Material m = material_of(scene);
    EXPECT_EQ(m.name, "paint");
    EXPECT_EQ(m.base_color, vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.metallic, 0.5f);
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_EQ(m.emissive, vec3(0.5f, 1, 0));
    EXPECT_TRUE(m.double_sided);
}

TEST_F(GltfMaterial, alphaModes) {
    const Scene mask_scene = load_with({{"alphaMode", "MASK"}, {"alphaCutoff", 0.75}});
    const Material mask = material_of(mask_scene);
    EXPECT_EQ(mask.alpha_mode, AlphaMode::Mask);
    EXPECT_EQ(mask.alpha_cutoff, 0.75f);
    const Scene blend_scene = load_with({{"alphaMode", "BLEND"}});
    EXPECT_EQ(material_of(blend_scene).alpha_mode, AlphaMode::Blend);
}

TEST_F(GltfMaterial, unlitAndEmissiveStrength) {
    const Scene scene = load_with({{"emissiveFactor", {0.5, 1, 0}},
                                   {"extensions",
                                    {{"KHR_materials_unlit", Json::object()},
                                     {"KHR_materials_emissive_strength", {{"emissiveStrength", 4.0}}}}}});
    const Material m = material_of(scene);
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(m.emissive, vec3(2, 4, 0));
}

TEST_F(GltfMaterial, allFiveTexturesWithSetsTransformsAndStrengths) {
    GltfBuilder gltf = GltfBuilder::triangle();
    const int image = gltf.add_image(two_by_one());
    for (int i = 0; i < 5; ++i) gltf.add("textures", {{"source", image}});
    const Json transform = {{"offset", {0.25, 0.5}}, {"rotation", 1.0}, {"scale", {2, 3}}, {"texCoord", 1}};
    gltf.primitive()["material"] = gltf.add(
        "materials",
        {{"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}},
           {"metallicRoughnessTexture", {{"index", 1}, {"texCoord", 1}}}}},
         {"normalTexture", {{"index", 2}, {"scale", 0.5}}},
         {"occlusionTexture", {{"index", 3}, {"strength", 0.25}}},
         {"emissiveTexture", {{"index", 4}}}});
    const Scene scene = load(gltf);
    const Material m = material_of(scene);
    ASSERT_TRUE(m.base_color_texture && m.metallic_roughness_texture && m.normal_texture &&
                m.occlusion_texture && m.emissive_texture);
    EXPECT_EQ(m.base_color_texture.uv_set, 1u);
    EXPECT_EQ(m.base_color_texture.offset, vec2(0.25f, 0.5f));
    EXPECT_EQ(m.base_color_texture.scale, vec2(2, 3));
    EXPECT_EQ(m.base_color_texture.rotation, 1.0f);
    EXPECT_EQ(m.metallic_roughness_texture.uv_set, 1u);
    EXPECT_EQ(m.emissive_texture.uv_set, 0u);
    EXPECT_EQ(m.normal_scale, 0.5f);
    EXPECT_EQ(m.occlusion_strength, 0.25f);
    EXPECT_EQ(scene.textures.size(), 5u);
}

TEST_F(GltfMaterial, anImageUsedAsColourAndAsDataIsKeptOnce) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.add("textures", {{"source", gltf.add_image(two_by_one())}});
    gltf.primitive()["material"] =
        gltf.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                               {"occlusionTexture", {{"index", 0}}}});
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].pixels.pixels, two_by_one().pixels);
    const Material m = material_of(scene);
    EXPECT_EQ(m.base_color_texture.texture, m.occlusion_texture.texture);
}

TEST_F(GltfMaterial, imagesInFilesAndPercentEncodedNames) {
    GltfBuilder gltf = GltfBuilder::triangle();
    write_png(folder_.path() / "a picture.png", two_by_one());
    gltf.add("images", {{"uri", "a%20picture.png"}});
    gltf.add("textures", {{"source", 0}});
    gltf.primitive()["material"] = gltf.add("materials", {{"emissiveTexture", {{"index", 0}}}});
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.images[0].pixels.pixels, two_by_one().pixels);
}

TEST_F(GltfMaterial, samplers) {
    GltfBuilder gltf = GltfBuilder::triangle();
    const int image = gltf.add_image(two_by_one());
    gltf.add("samplers", {{"magFilter", 9728}, {"minFilter", 9985}, {"wrapS", 33071}, {"wrapT", 33648}});
    gltf.add("samplers", {{"magFilter", 9729}, {"minFilter", 9728}});
    gltf.add("textures", {{"source", image}, {"sampler", 0}});
    gltf.add("textures", {{"source", image}, {"sampler", 1}});
    gltf.add("textures", {{"source", image}});
    gltf.primitive()["material"] = gltf.add("materials", {{"normalTexture", {{"index", 0}}},
                                                          {"occlusionTexture", {{"index", 1}}},
                                                          {"emissiveTexture", {{"index", 2}}}});
    const Scene scene = load(gltf);
    const Material m = material_of(scene);
    const auto sampler = [&](const TextureUse& use) { return scene.textures[*use.texture].sampler; };
    EXPECT_EQ(sampler(m.normal_texture), (Sampler{Filter::Nearest, Filter::Linear, MipFilter::Nearest,
                                                  Wrap::ClampToEdge, Wrap::MirroredRepeat}));
    EXPECT_EQ(sampler(m.occlusion_texture),
              (Sampler{Filter::Linear, Filter::Nearest, MipFilter::None, Wrap::Repeat, Wrap::Repeat}));
    EXPECT_EQ(sampler(m.emissive_texture), Sampler{});
}

TEST_F(GltfMaterial, optionalExtensionsThatAreNotSupportedAreNamedInOneWarning) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.json["extensionsUsed"] = {"KHR_materials_sheen", "KHR_materials_unlit", "KHR_materials_clearcoat"};
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("KHR_materials_sheen, KHR_materials_clearcoat"), std::string::npos);
    EXPECT_EQ(scene.warnings[0].find("unlit"), std::string::npos);
}

TEST_F(GltfMaterial, aTextureInAFormatOfAnOptionalExtensionIsLeftOut) {
    GltfBuilder gltf = GltfBuilder::triangle();
    gltf.add("textures", {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
    gltf.primitive()["material"] = gltf.add("materials", {{"emissiveTexture", {{"index", 0}}}});
    const Scene scene = load(gltf);
    EXPECT_FALSE(material_of(scene).emissive_texture);
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(UvMatrix, scalesThenRotatesThenMoves) {
    TextureUse use;
    use.offset = {0.1f, 0.2f};
    use.scale = {2.0f, 3.0f};
    use.rotation = pi / 2;
    // A quarter turn counter-clockwise in a picture whose v grows downwards takes +u to -v and +v to +u.
    const vec3 uv = uv_matrix(use) * vec3(0.5f, 0.25f, 1.0f);
    EXPECT_NEAR(uv.x, 0.1f + 3.0f * 0.25f, 1e-6f);
    EXPECT_NEAR(uv.y, 0.2f - 2.0f * 0.5f, 1e-6f);
}

}  // namespace
}  // namespace foveray::scene
