#include <random>

#include "base/error.h"
#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

using fakes::GltfBuilder;

/// A small file with some of everything: texture, skin, morph target, animation, light, instancing, sparse
/// accessor.
GltfBuilder rich_model() {
    GltfBuilder gltf = GltfBuilder::triangle();
    Image image(2, 2, 4);
    std::fill(image.pixels.begin(), image.pixels.end(), std::uint8_t{200});
    gltf.add("samplers", {{"wrapS", 33071}});
    gltf.add("textures", {{"source", gltf.add_image(image)}, {"sampler", 0}});
    gltf.add("materials", {{"normalTexture",
                            {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}}}}}}},
                           {"alphaMode", "MASK"}});
    Json& attributes = gltf.primitive()["attributes"];
    attributes["NORMAL"] = gltf.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    attributes["TEXCOORD_0"] = gltf.add_accessor<std::uint16_t>({0, 0, 65535, 0, 0, 65535}, "VEC2", true);
    attributes["JOINTS_0"] = gltf.add_accessor<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_0"] = gltf.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    const int delta = gltf.add_accessor<float>({0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC3");
    const int sparse_index = gltf.add_view<std::uint16_t>({1}),
              sparse_value = gltf.add_view<float>({0, 0, 2});
    gltf.json["accessors"][delta]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", sparse_index}, {"componentType", 5123}}},
        {"values", {{"bufferView", sparse_value}}}};
    gltf.primitive()["targets"] = Json::array({{{"POSITION", delta}}});
    gltf.primitive()["material"] = 0;
    gltf.primitive()["indices"] = gltf.add_accessor<std::uint16_t>({0, 1, 2}, "SCALAR");
    gltf.json["nodes"][0]["skin"] = 0;
    gltf.add_root({{"children", {2}}, {"translation", {0, 1, 0}}});
    gltf.add("nodes", {{"rotation", {0, 0, 0, 1}}});
    gltf.add("skins", {{"joints", {1, 2}}});
    const int times = gltf.add_accessor<float>({0, 1}, "SCALAR");
    const int turns = gltf.add_accessor<float>({0, 0, 0, 1, 0, 1, 0, 0}, "VEC4");
    gltf.add("animations",
             {{"samplers", {{{"input", times}, {"output", turns}}}},
              {"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}}}}});
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    const int moves = gltf.add_accessor<float>({0, 0, 0, 1, 1, 1}, "VEC3");
    const int plain = gltf.add_mesh({{"attributes", {{"POSITION", 0}}}});
    gltf.add_root({{"mesh", plain},
                   {"extensions",
                    {{"KHR_lights_punctual", {{"light", 0}}},
                     {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", moves}}}}}}}});
    return gltf;
}

class CorruptGltf : public GltfTest {
  protected:
    /// Loads and plays it; the one way to refuse a file is a Fault of one line.
    void try_to_load(const std::string& name, const std::string& bytes) {
        try {
            const Scene scene = load_file(folder_.write(name, bytes));
            SceneAnimator animator(scene);
            animator.advance(from_seconds(0.5));
            ++loaded_;
        } catch (const Fault& fault) {
            EXPECT_EQ(fault.code(), ExitCode::BadInput);
            EXPECT_EQ(std::string(fault.what()).find('\n'), std::string::npos) << fault.what();
            EXPECT_FALSE(fault.remedy().empty()) << fault.what();
            ++refused_;
        }
    }
    int loaded_ = 0, refused_ = 0;
};

TEST_F(CorruptGltf, theModelItselfIsSound) {
    const Scene scene = load(rich_model());
    EXPECT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.animations.size(), 1u);
    EXPECT_EQ(scene.skins.size(), 1u);
}

TEST_F(CorruptGltf, truncationsAreRefused) {
    const GltfBuilder gltf = rich_model();
    const std::string text = gltf.text(), binary = gltf.binary();
    for (std::size_t i = 0; i < 40; ++i) {
        try_to_load("model.gltf", text.substr(0, text.size() * i / 40));
        try_to_load("model.glb", binary.substr(0, binary.size() * i / 40));
    }
    EXPECT_EQ(refused_, 80);
}

TEST_F(CorruptGltf, flippedBitsNeverCrash) {
    const GltfBuilder gltf = rich_model();
    std::minstd_rand random(1);
    for (int i = 0; i < 300; ++i) {
        std::string bytes = i % 2 ? gltf.text() : gltf.binary();
        for (int flips = 0; flips < 1 + i % 3; ++flips) {
            bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
        }
        try_to_load(i % 2 ? "model.gltf" : "model.glb", bytes);
    }
    EXPECT_EQ(loaded_ + refused_, 300);
    EXPECT_GT(refused_, 50);
}

TEST_F(CorruptGltf, everyValueReplacedByNonsense) {
    const GltfBuilder gltf = rich_model();
    const Json flat = gltf.json.flatten();
    for (const auto& [pointer, value] : flat.items()) {
        for (const Json& nonsense : {Json(-1), Json(4000000000u), Json("x"), Json(1.5e300)}) {
            GltfBuilder bad = gltf;
            bad.json[Json::json_pointer(pointer)] = nonsense;
            try_to_load("model.gltf", bad.text());
        }
    }
    EXPECT_GT(refused_, 100);
}

TEST_F(CorruptGltf, everyObjectAndArrayReplacedByNonsense) {
    const GltfBuilder gltf = rich_model();
    std::vector<Json::json_pointer> places;
    const auto collect = [&](const auto& self, const Json& value, const Json::json_pointer& place) -> void {
        if (!value.is_structured()) return;
        if (!place.empty()) places.push_back(place);
        for (const auto& [key, element] : value.items()) {
            self(self, element, value.is_array() ? place / std::stoul(key) : place / key);
        }
    };
    collect(collect, gltf.json, Json::json_pointer());
    for (const Json::json_pointer& place : places) {
        for (const Json& nonsense : {Json(0), Json::array({Json::array()}), Json(nullptr)}) {
            GltfBuilder bad = gltf;
            bad.json[place] = nonsense;
            try_to_load("model.gltf", bad.text());
        }
    }
    EXPECT_GT(refused_, 100);
}

}  // namespace
}  // namespace foveray::scene
