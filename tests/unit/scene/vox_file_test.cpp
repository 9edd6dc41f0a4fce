// MagicaVoxel files, made here byte by byte.
#include "render/scene/vox_file.h"

#include <set>

#include <gtest/gtest.h>

#include "base/image.h"
#include "shaders/shared/voxels.h"
#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"
#include "tests/unit/scene/vox_builder.h"
#include "tests/unit/scene/voxel_walk.h"

namespace foveray::scene {
namespace {

class VoxFileTest : public testing::Test {
  protected:
    Voxels read(const VoxBuilder& vox, float size = 1.0f) {
        return read_vox(folder_.write("a.vox", vox.bytes()), size);
    }
    void expect_refused(const std::string& bytes, const std::string& part) {
        const auto file = folder_.write("bad.vox", bytes);
        fakes::expect_fault([&] { read_vox(file, 1.0f); }, ExitCode::BadInput, part);
        fakes::expect_fault([&] { read_vox(file, 1.0f); }, ExitCode::BadInput, "bad.vox");
    }

    fakes::TemporaryFolder folder_;
};

/// Lowest corners of all voxels, in object space.
std::set<std::array<int, 3>> places_of(const Voxels& v) {
    std::set<std::array<int, 3>> places;
    walk(v, [&](std::uint32_t, std::uint32_t level, glm::uvec3 place) {
        if (level > 0) return;
        const vec3 p = glm::round(v.origin / v.voxel_size + vec3(place));
        places.insert({static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)});
    });
    return places;
}

vec3 only_color(const Voxels& v) { return shared::voxel_color(v.nodes.back().x); }

TEST_F(VoxFileTest, aModelWithoutASceneGraphStandsOnTheMiddleOfItsFloor) {
    const Voxels v = read(VoxBuilder().model(4, 6, 3, {{0, 0, 0, 1}, {3, 5, 2, 1}}), 0.25f);
    EXPECT_FLOAT_EQ(v.voxel_size, 0.25f);
    EXPECT_TRUE(v.show_faces);
    // x goes from -2 to 2; y, the file's z, from 0 to 3; z, the file's -y, from -3 to 3.
    EXPECT_EQ(places_of(v), (std::set<std::array<int, 3>>{{-2, 0, 2}, {1, 2, -3}}));
    EXPECT_FLOAT_EQ(v.bounds().max.y, 0.75f);
}

TEST_F(VoxFileTest, coloursComeFromTheFileOrTheDefaultPalette) {
    EXPECT_EQ(only_color(read(VoxBuilder().model(1, 1, 1, {{0, 0, 0, 1}}))), vec3(1.0f));
    const vec3 third = only_color(read(VoxBuilder().model(1, 1, 1, {{0, 0, 0, 3}})));  // 0xFF99FFFF
    EXPECT_NEAR(third.r, 1.0f, 1e-3f);
    EXPECT_NEAR(third.b, linear_from_srgb(0.6f), 0.004f);
    const vec3 red = only_color(read(VoxBuilder().model(1, 1, 1, {{0, 0, 0, 216}})));  // 0xFF0000EE
    EXPECT_NEAR(red.r, linear_from_srgb(238.0f / 255.0f), 0.004f);
    EXPECT_EQ(red.g, 0.0f);
    const vec3 grey = only_color(read(VoxBuilder().model(1, 1, 1, {{0, 0, 0, 255}})));
    EXPECT_NEAR(grey.g, linear_from_srgb(17.0f / 255.0f), 0.002f);

    std::string palette(1024, '\0');
    palette[4 * 6 + 1] = '\xFF';  // colour 7 is the palette's entry 6
    EXPECT_EQ(only_color(read(VoxBuilder().model(1, 1, 1, {{0, 0, 0, 7}}).chunk("RGBA", palette))),
              vec3(0, 1, 0));
}

TEST_F(VoxFileTest, theSceneGraphMovesAndTurnsModels) {
    // Turned by a quarter round the file's z: x to y, y to -x, which is rows (0 -1 0), (1 0 0), (0 0 1).
    const std::string quarter = std::to_string(1 | 0 << 2 | 1 << 4);
    const VoxBuilder vox = VoxBuilder()
                               .model(3, 1, 1, {{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}})
                               .transform(0, 1, {})
                               .group(1, {2, 4, 6})
                               .transform(2, 3, {{"_t", "10 0 0"}})
                               .shape(3, 0)
                               .transform(4, 5, {{"_t", "0 20 5"}, {"_r", quarter}})
                               .shape(5, 0)
                               .transform(6, 7, {{"_t", "0 0 99"}}, {{"_hidden", "1"}})
                               .shape(7, 0);
    // A model's middle is at half its size, rounded down: x -1 … 1, and along y and z the cell from 0 to 1,
    // which the quarter turn takes to the x cell from -1 to 0.
    EXPECT_EQ(places_of(read(vox)),
              (std::set<std::array<int, 3>>{
                  {9, 0, -1}, {10, 0, -1}, {11, 0, -1}, {-1, 5, -20}, {-1, 5, -21}, {-1, 5, -22}}));
}

TEST_F(VoxFileTest, unknownChunksAreSkipped) {
    const VoxBuilder vox =
        VoxBuilder().chunk("rOBJ", "????").model(1, 1, 1, {{0, 0, 0, 1}}).chunk("NOTE", "");
    EXPECT_EQ(read(vox).voxel_count(), 1u);
}

TEST_F(VoxFileTest, whatNobodySeesIsLeftOut) {
    std::vector<VoxBuilder::Voxel> cube;
    for (int i = 0; i < 125; ++i) cube.push_back({i % 5, i / 5 % 5, i / 25, 1});
    EXPECT_EQ(read(VoxBuilder().model(5, 5, 5, cube)).voxel_count(), 125u - 27u);
}

TEST_F(VoxFileTest, aFileCutShortAnywhereIsRefused) {
    const std::string whole = VoxBuilder()
                                  .model(2, 2, 2, {{0, 0, 0, 1}, {1, 1, 1, 9}})
                                  .transform(0, 1, {{"_t", "1 2 3"}, {"_r", "4"}})
                                  .shape(1, 0)
                                  .chunk("RGBA", std::string(1024, '\x40'))
                                  .bytes();
    read_vox(folder_.write("whole.vox", whole), 1.0f);
    for (std::size_t length = 0; length < whole.size(); ++length)
        expect_refused(whole.substr(0, length), ".vox");
}

TEST_F(VoxFileTest, anyByteMayBeWrong) {
    const std::string whole = VoxBuilder()
                                  .model(2, 2, 2, {{0, 0, 0, 1}, {1, 1, 1, 9}})
                                  .transform(0, 1, {{"_t", "1 2 3"}, {"_r", "4"}})
                                  .group(1, {2})
                                  .shape(2, 0)
                                  .bytes();
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (const int value : {0x00, 0x01, 0x7F, 0x80, 0xFF}) {
            std::string wrong = whole;
            wrong[i] = static_cast<char>(value);
            const auto file = folder_.write("wrong.vox", wrong);
            try {
                read_vox(file, 1.0f);
            } catch (const Fault& fault) {
                EXPECT_EQ(fault.code(), ExitCode::BadInput);
            }
        }
    }
}

TEST_F(VoxFileTest, whatItClaimsMustBeThere) {
    const auto word = VoxBuilder::word;
    const std::string size = word(2) + word(2) + word(2);
    expect_refused(VoxBuilder().chunk("SIZE", size).chunk("XYZI", word(0xFFFFFFFF)).bytes(), "cut short");
    expect_refused(VoxBuilder().chunk("SIZE", size).chunk("XYZI", word(0x40000001) + word(0)).bytes(),
                   "cut short");
    expect_refused(VoxBuilder().chunk("SIZE", size).bytes(), "no XYZI");
    expect_refused(VoxBuilder().chunk("XYZI", word(0)).bytes(), "no SIZE");
    expect_refused(VoxBuilder().chunk("SIZE", word(0) + word(2) + word(2)).bytes(), "0 voxels wide");
    expect_refused(VoxBuilder().chunk("SIZE", word(2) + word(0x7FFFFFFF) + word(2)).bytes(), "voxels wide");
    expect_refused(VoxBuilder().chunk("SIZE", word(2) + word(-1) + word(2)).bytes(),
                   "4294967295 voxels wide");
    expect_refused(VoxBuilder().model(2, 2, 2, {{0, 0, 0, 0}}).bytes(), "colour 0");
    expect_refused(VoxBuilder().model(2, 2, 2, {{0, 2, 0, 1}}).bytes(), "outside");
    expect_refused(VoxBuilder().model(2, 2, 2, {}).bytes(), "no voxel");
    expect_refused(VoxBuilder().bytes(), "no model");
    expect_refused("no such thing", "VOX");
}

TEST_F(VoxFileTest, aSceneGraphInCirclesOrTooLargeIsRefused) {
    const VoxBuilder model = VoxBuilder().model(1, 1, 1, {{0, 0, 0, 1}});
    expect_refused(VoxBuilder(model).transform(0, 0, {}).bytes(), "circles");
    expect_refused(VoxBuilder(model).transform(0, 5, {}).bytes(), "not there");
    expect_refused(VoxBuilder(model).shape(0, 3).bytes(), "not there");
    expect_refused(VoxBuilder(model).shape(0, 0).shape(0, 0).bytes(), "two nodes");
    expect_refused(VoxBuilder(model).transform(0, 1, {{"_r", "3"}}).shape(1, 0).bytes(), "no rotation");
    expect_refused(VoxBuilder(model).transform(0, 1, {{"_t", "1 x"}}).shape(1, 0).bytes(), "no translation");
    VoxBuilder doubling(model);  // 2^40 times the same model
    for (int i = 0; i < 40; ++i) doubling.group(i, {i + 1, i + 1});
    expect_refused(doubling.shape(40, 0).bytes(), "too large");
    const VoxBuilder far = VoxBuilder(model)
                               .group(0, {1, 3})
                               .transform(1, 2, {{"_t", "-600 0 0"}})
                               .shape(2, 0)
                               .transform(3, 4, {{"_t", "600 0 0"}})
                               .shape(4, 0);
    expect_refused(far.bytes(), "1024");
}

TEST_F(VoxFileTest, aMissingFileIsNamed) {
    fakes::expect_fault([&] { read_vox(folder_ / "none.vox", 1.0f); }, ExitCode::BadInput, "none.vox");
}

}  // namespace
}  // namespace foveray::scene
