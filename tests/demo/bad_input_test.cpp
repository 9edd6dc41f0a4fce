// Every kind of bad input: one clear line, exit code 2, nothing left in OUT, no validation message.
#include <fstream>

#include <gtest/gtest.h>

#include "base/headset_profile.h"
#include "base/image.h"
#include "tests/demo/run_program.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray {
namespace {

namespace fs = std::filesystem;

class BadInput : public testing::Test {
  protected:
    void SetUp() override {
        folder_.write(
            "session/session.json",
            R"({"format":"foveray-session","version":1,"headset":"ci","rate_hz":10,"frames":2,"recorded":[]})");
        folder_.write("text.png", "this is no picture");
    }

    /// Replays with these arguments and expects a refusal that names `part`.
    void refuse(std::vector<std::string> arguments, const std::string& part) {
        arguments.insert(arguments.begin(), "replay");
        if (arguments[1].starts_with("--")) arguments.insert(arguments.begin() + 1, path("session"));
        arguments.insert(arguments.end(), {"--out", path("out")});
        const auto result = fakes::run_foveray(arguments);
        EXPECT_EQ(result.exit_code, 2) << part << "\n" << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << part << "\n" << result.err;
        EXPECT_EQ(result.err.find("Validation"), std::string::npos) << result.err;
        EXPECT_NE(result.err.find("foveray: error: "), std::string::npos) << result.err;
        for (const auto& entry : fs::directory_iterator(folder_.path())) {
            EXPECT_FALSE(entry.path().filename().string().starts_with("out"))
                << "left behind: " << entry.path();
        }
    }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    /// A glTF file of one triangle whose JSON text is changed by replacing `from` with `to`.
    std::string gltf(const std::string& from, const std::string& to) {
        std::string text =
            R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],"images":[{"uri":"white.png"}],
"buffers":[{"byteLength":42,"uri":"tri.bin"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";
        if (const auto at = text.find(from); !from.empty() && at != std::string::npos) {
            text.replace(at, from.size(), to);
        }
        std::string data(36, '\0');
        data += std::string("\0\0\1\0\2\0", 6);
        folder_.write("tri.bin", data);
        return folder_.write("tri.gltf", text).string();
    }

    fakes::TemporaryFolder folder_;
};

TEST_F(BadInput, Arguments) {
    refuse({"--colour"}, "--colour");
    refuse({"--set", "lighting.shadow_sample=4"}, "did you mean lighting.shadow_samples");
    refuse({"--set", "lighting.shadow_samples=1000"}, "between 1 and 256");
    refuse({"--frames", "5:9"}, "--frames");
    refuse({"--frames", "1"}, "--frames");
    refuse({"--gpu", "99", "--scene", (assets_folder() / "scenes/primitives.json").string()}, "99");
    const auto nothing = fakes::run_foveray({"polish"});
    EXPECT_EQ(nothing.exit_code, 2);
    EXPECT_NE(nothing.err.find("polish"), std::string::npos);
}

TEST_F(BadInput, Sessions) {
    refuse({path("none")}, "none");
    folder_.write("empty/readme.txt", "");
    refuse({path("empty")}, "session.json");
    folder_.write("broken/session.json", "{\n");
    refuse({path("broken")}, "session.json:");
    folder_.write(
        "nan/session.json",
        R"({"format":"foveray-session","version":1,"headset":"ci","rate_hz":10,"frames":2,"recorded":["head"]})");
    folder_.write("nan/head.csv", "time_ns,px,py,pz,qx,qy,qz,qw\n0,0,nan,0,0,0,0,1\n");
    refuse({path("nan")}, "head.csv:2");
}

TEST_F(BadInput, Profiles) {
    refuse({"--headset", "varjo-xr9"}, "varjo-xr1");
    refuse({"--headset", folder_.write("p.json", R"({"format":"foveray-headset","version":1})").string()},
           "p.json");
}

TEST_F(BadInput, Scenes) {
    refuse({"--scene", path("none.json")}, "none.json");
    refuse({"--scene", path("none.glb")}, "none.glb");
    refuse({"--scene", folder_.write("s.json", "[1,\n2").string()}, "s.json:2");
    refuse(
        {"--scene", folder_.write("s.json", R"({"format":"foveray-scene","version":1,"lamps":[]})").string()},
        "lamps");
    refuse(
        {"--scene",
         folder_.write("s.json", R"({"format":"foveray-scene","version":1,"models":[{"file":"gone.glb"}]})")
             .string()},
        "gone.glb");
    refuse(
        {"--scene",
         folder_
             .write("s.json", R"({"format":"foveray-scene","version":1,"environment":{"file":"text.png"}})")
             .string()},
        "text.png");
    refuse({"--scene", folder_.write("bad.glb", "glTF but not really").string()}, "bad.glb");
}

TEST_F(BadInput, Objects) {
    const auto refuse_object = [&](const std::string& object, const std::string& part) {
        refuse(
            {"--scene",
             folder_.write("s.json", R"({"format":"foveray-scene","version":1,"objects":[{)" + object + "}]}")
                 .string()},
            part);
    };
    refuse_object(R"("shape":"spere")", "\"spere\" is no shape");
    refuse_object(R"("shape":"sphere","parameters":{"radius":-1})", "/objects/0/parameters/radius");
    refuse_object(R"("shape":"mandelbulb","parameters":{"power":1e300})", "/objects/0/parameters/power");
    refuse_object(R"("shape":"sphere","transform":{"scale":[1,0,1]})", "/objects/0/transform/scale/1");
    refuse_object(R"("shape":"csg","solid":{"sphere":{"radius":1e-20}})", "/objects/0/solid");
    refuse_object(R"("shape":"blend","parts":[])", "/objects/0/parts");
    folder_.write("ball.glsl", "float distance_at(vec3 p) { return length(p) - 0.5; }");
    refuse_object(R"("shape":"user","file":"ball.glsl","bounds":{"min":[0,0,0],"max":[0,0,0]})",
                  "/objects/0/bounds: have no volume");
    refuse_object(R"("shape":"user","file":"ball.glsl","bounds":{"min":[-1,-1,-1],"max":[1,1e30,1]})",
                  "/objects/0/bounds: are too large");
    refuse_object(R"("shape":"user","file":"ball.glsl","bounds":{"min":[-1,-1,-1],"max":[1,1e999,1]})",
                  "too large");
    // MagicaVoxel: cut short, and 2^32 - 1 voxels in a chunk of a few bytes.
    const auto word = [](std::uint32_t value) {
        std::string bytes(4, '\0');
        for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (8 * i));
        return bytes;
    };
    const std::string size = "SIZE" + word(12) + word(0) + word(2) + word(2) + word(2);
    const auto vox = [&](const std::string& chunks) {
        return "VOX " + word(150) + "MAIN" + word(0) + word(static_cast<std::uint32_t>(chunks.size())) +
               chunks;
    };
    const std::string claim = vox(size + "XYZI" + word(8) + word(0) + word(0xFFFFFFFFu) + word(0x01000000u));
    folder_.write("claim.vox", claim);
    refuse_object(R"("shape":"voxels","file":"claim.vox")", "claim.vox");
    folder_.write("short.vox", claim.substr(0, claim.size() - 9));
    refuse_object(R"("shape":"voxels","file":"short.vox")", "short.vox");
}

TEST_F(BadInput, GltfContents) {
    folder_.write("white.png", "not a picture");
    refuse({"--scene", gltf("", "")}, "white.png");
    write_png(path("white.png"), Image(2, 2, 3));
    refuse({"--scene", gltf("\"byteOffset\":36,\"byteLength\":6", "\"byteOffset\":40,\"byteLength\":6")},
           "tri.gltf");
    refuse({"--scene", gltf("\"count\":3,\"type\":\"SCALAR\"", "\"count\":300,\"type\":\"SCALAR\"")},
           "tri.gltf");
    refuse({"--scene", gltf("\"POSITION\":0", "\"POSITION\":7")}, "tri.gltf");
    refuse({"--scene", gltf("\"uri\":\"tri.bin\"", "\"uri\":\"gone.bin\"")}, "gone.bin");
    refuse({"--scene", gltf("\"asset\":", "\"extensionsRequired\":[\"EXT_magic\"],\"asset\":")}, "EXT_magic");
}

TEST_F(BadInput, Cameras) {
    refuse({"--camera", path("none.mp4")}, "none.mp4");
    refuse({"--camera", folder_.write("v.mp4", "no video").string()}, "v.mp4");
    refuse({"--camera", (assets_folder() / "feeds/demo.mp4").string(), "--calibration",
            folder_.write("c.json", R"({"format":"foveray-calibration","version":1})").string()},
           "c.json");
    refuse({"--camera", "/dev/video0"}, "/dev/video0");
}

TEST_F(BadInput, OutputThatIsNotOurs) {
    folder_.write("thesis/chapter1.txt", "dear to somebody");
    const auto result = fakes::run_foveray({"replay", path("session"), "--out", path("thesis"), "--scene",
                                            (assets_folder() / "scenes/primitives.json").string()});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(fs::exists(path("thesis/chapter1.txt")));
}

}  // namespace
}  // namespace foveray
