#include <limits>

#include "tests/fakes/expect_fault.h"
#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

using fakes::GltfBuilder;

class GltfBadInput : public GltfTest {
  protected:
    void expect_bad(const GltfBuilder& gltf, const std::string& part) {
        fakes::expect_fault([&] { load(gltf); }, ExitCode::BadInput, part);
    }
    void expect_bad_text(const std::string& text, const std::string& part) {
        fakes::expect_fault([&] { load_file(folder_.write("model.gltf", text)); }, ExitCode::BadInput, part);
    }
    GltfBuilder gltf_ = GltfBuilder::triangle();
};

TEST_F(GltfBadInput, missingFile) {
    fakes::expect_fault([&] { load_file(folder_.path() / "nothing.gltf"); }, ExitCode::BadInput,
                        "nothing.gltf");
}

TEST_F(GltfBadInput, malformedJsonNamesTheLine) { expect_bad_text("{\n\"asset\": {\n", "model.gltf:3"); }

TEST_F(GltfBadInput, notAnObject) { expect_bad_text("[1, 2]", "must be an object"); }

TEST_F(GltfBadInput, deepNesting) { expect_bad_text(std::string(100000, '['), "nested too deeply"); }

TEST_F(GltfBadInput, numberTooLargeForADouble) {
    expect_bad_text(R"({"asset": {"version": "2.0"}, "scene": 1e999})", "too large");
}

TEST_F(GltfBadInput, version1) {
    gltf_.json["asset"]["version"] = "1.0";
    expect_bad(gltf_, "/asset/version");
}

TEST_F(GltfBadInput, requiredExtensionsAreNamed) {
    gltf_.json["extensionsRequired"] = {"KHR_draco_mesh_compression", "KHR_texture_basisu",
                                        "KHR_materials_unlit"};
    expect_bad(gltf_, "KHR_draco_mesh_compression, KHR_texture_basisu (");
}

TEST_F(GltfBadInput, indexPastTheVertices) {
    gltf_.primitive()["indices"] = gltf_.add_accessor<std::uint16_t>({0, 1, 3}, "SCALAR");
    expect_bad(gltf_, "/meshes/0/primitives/0/indices: element 2 is 3, but there are 3 vertices");
}

TEST_F(GltfBadInput, accessorPastItsBufferView) {
    gltf_.json["accessors"][0]["count"] = 4;
    expect_bad(gltf_, "/meshes/0/primitives/0/attributes/POSITION (accessor 0): reaches past the 36 bytes");
}

TEST_F(GltfBadInput, accessorOffsetNearTheEndOfTheAddressSpace) {
    gltf_.json["accessors"][0]["byteOffset"] = std::numeric_limits<std::uint64_t>::max() - 3;
    expect_bad(gltf_, "reaches past");
}

TEST_F(GltfBadInput, bufferViewPastItsBuffer) {
    gltf_.json["bufferViews"][0]["byteLength"] = 1000;
    expect_bad(gltf_, "/bufferViews/0: reaches past the 36 bytes of its buffer");
}

TEST_F(GltfBadInput, bufferShorterThanStated) {
    Json json = gltf_.json;
    json["buffers"] = Json::array({{{"byteLength", 40}, {"uri", GltfBuilder::data_uri(gltf_.bytes)}}});
    expect_bad_text(json.dump(), "/buffers/0: holds 36 bytes, not the 40");
}

TEST_F(GltfBadInput, bufferFileMissing) {
    Json json = gltf_.json;
    json["buffers"] = Json::array({{{"byteLength", 36}, {"uri", "points.bin"}}});
    expect_bad_text(json.dump(), "/buffers/0/uri");
}

TEST_F(GltfBadInput, referencesOutOfRange) {
    const auto expect_reference = [&](const Json::json_pointer& place, const Json& value) {
        GltfBuilder gltf = GltfBuilder::triangle();
        gltf.json[place] = value;
        expect_bad(gltf, place.to_string() + ": ");
    };
    expect_reference("/scene"_json_pointer, 7);
    expect_reference("/scenes/0/nodes/0"_json_pointer, 7);
    expect_reference("/nodes/0/mesh"_json_pointer, 1);
    expect_reference("/nodes/0/mesh"_json_pointer, -1);
    expect_reference("/nodes/0/mesh"_json_pointer, "0");
    expect_reference("/nodes/0/skin"_json_pointer, 0);
    expect_reference("/nodes/0/camera"_json_pointer, 0);
    expect_reference("/nodes/0/children/0"_json_pointer, 3);
    expect_reference("/meshes/0/primitives/0/material"_json_pointer, 0);
    expect_reference("/meshes/0/primitives/0/indices"_json_pointer, 5);
    expect_reference("/meshes/0/primitives/0/attributes/POSITION"_json_pointer, 5);
    expect_reference("/accessors/0/bufferView"_json_pointer, 5);
    expect_reference("/bufferViews/0/buffer"_json_pointer, 5);
    expect_reference("/nodes/0/extensions/KHR_lights_punctual/light"_json_pointer, 0);
}

TEST_F(GltfBadInput, cyclesInTheNodeTree) {
    gltf_.add("nodes", {{"children", {2}}});
    gltf_.add("nodes", {{"children", {1}}});
    expect_bad(gltf_, "is its own ancestor");
}

TEST_F(GltfBadInput, nodeWithTwoParents) {
    gltf_.add("nodes", Json::object());
    gltf_.add_root({{"children", {1}}});
    gltf_.add_root({{"children", {1}}});
    expect_bad(gltf_, "/nodes/3/children/0: node 1 has a second parent");
}

TEST_F(GltfBadInput, positionThatIsNotANumber) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    gltf_.primitive()["attributes"]["POSITION"] =
        gltf_.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, nan, 0}, "VEC3");
    expect_bad(gltf_, "attributes/POSITION: holds a number that is not finite in element 2");
}

TEST_F(GltfBadInput, attributeOfAnotherLength) {
    gltf_.primitive()["attributes"]["NORMAL"] = gltf_.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC3");
    expect_bad(gltf_, "attributes/NORMAL: has 2 elements where the primitive has 3 vertices");
}

TEST_F(GltfBadInput, attributeOfAnotherType) {
    gltf_.json["accessors"][0]["type"] = "VEC2";
    expect_bad(gltf_, "must have 3 components");
}

TEST_F(GltfBadInput, sparseIndexPastTheEnd) {
    const int indices = gltf_.add_view<std::uint16_t>({9});
    const int values = gltf_.add_view<float>({0, 0, 0});
    gltf_.json["accessors"][0]["sparse"] = {{"count", 1},
                                            {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                            {"values", {{"bufferView", values}}}};
    expect_bad(gltf_, "sparse index past its end");
}

TEST_F(GltfBadInput, textureThatIsNotAnImage) {
    folder_.write("note.png", "this is text");
    gltf_.add("images", {{"uri", "note.png"}});
    gltf_.add("textures", {{"source", 0}});
    gltf_.add("materials", {{"emissiveTexture", {{"index", 0}}}});
    expect_bad(gltf_, "/images/0 (note.png): not a readable image");
}

TEST_F(GltfBadInput, imageFileMissing) {
    gltf_.add("images", {{"uri", "gone.png"}});
    gltf_.add("textures", {{"source", 0}});
    gltf_.add("materials", {{"emissiveTexture", {{"index", 0}}}});
    expect_bad(gltf_, "/images/0/uri");
}

TEST_F(GltfBadInput, zeroQuaternion) {
    gltf_.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
    expect_bad(gltf_, "/nodes/0/rotation");
}

TEST_F(GltfBadInput, matrixOfTheWrongLength) {
    gltf_.json["nodes"][0]["matrix"] = {1, 0, 0};
    expect_bad(gltf_, "/nodes/0/matrix");
}

TEST_F(GltfBadInput, valuesOfTheWrongType) {
    for (const std::string key : {"nodes", "meshes", "accessors", "buffers", "materials"}) {
        GltfBuilder gltf = GltfBuilder::triangle();
        gltf.json[key] = "text";
        if (key != "buffers") expect_bad(gltf, "/" + key);
        gltf.json[key] = {1, 2};
        if (key != "buffers") expect_bad(gltf, "/" + key + "/0");
    }
    gltf_.json["meshes"][0]["primitives"] = {3};
    expect_bad(gltf_, "/meshes/0/primitives/0");
}

TEST_F(GltfBadInput, animationTimesThatDoNotIncrease) {
    const int times = gltf_.add_accessor<float>({0, 1, 1}, "SCALAR");
    const int values = gltf_.add_accessor<float>({0, 0, 0, 1, 0, 0, 2, 0, 0}, "VEC3");
    gltf_.add("animations",
              {{"samplers", {{{"input", times}, {"output", values}}}},
               {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    expect_bad(gltf_, "/animations/0/samplers/0/input");
}

TEST_F(GltfBadInput, animationWithTooFewValues) {
    const int times = gltf_.add_accessor<float>({0, 1, 2}, "SCALAR");
    const int values = gltf_.add_accessor<float>({0, 0, 0, 1, 0, 0}, "VEC3");
    gltf_.add("animations",
              {{"samplers", {{{"input", times}, {"output", values}}}},
               {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    expect_bad(gltf_, "/animations/0/samplers/0/output");
}

TEST_F(GltfBadInput, animationChannelWithoutItsSampler) {
    gltf_.add("animations",
              {{"samplers", Json::array()},
               {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    expect_bad(gltf_, "/animations/0/channels/0/sampler");
}

TEST_F(GltfBadInput, jointPastTheSkin) {
    Json& attributes = gltf_.primitive()["attributes"];
    attributes["JOINTS_0"] = gltf_.add_accessor<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_0"] = gltf_.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    gltf_.json["nodes"][0]["skin"] = 0;
    gltf_.add_root(Json::object());
    gltf_.add("skins", {{"joints", {1}}});
    expect_bad(gltf_, "/nodes/0/skin: has 1 joints, but the mesh uses joint 4");
}

TEST_F(GltfBadInput, truncatedBinary) {
    const std::string whole = gltf_.binary();
    fakes::expect_fault([&] { load_file(folder_.write("m.glb", whole.substr(0, whole.size() - 8))); },
                        ExitCode::BadInput, "the file ends");
}

}  // namespace
}  // namespace foveray::scene
