// Voxel objects of scene files.
#include <gtest/gtest.h>

#include "render/scene/scene_file.h"
#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"
#include "tests/unit/scene/vox_builder.h"

namespace foveray::scene {
namespace {

class VoxelObjectTest : public testing::Test {
  protected:
    VoxelObjectTest() {
        folder_.write("a.vox", VoxBuilder().model(2, 2, 2, {{0, 0, 0, 1}, {1, 1, 1, 2}}).bytes());
    }

    std::filesystem::path file_with(const std::string& objects) {
        return folder_.write("scene.json",
                             R"({"format":"foveray-scene","version":1,"objects":[)" + objects + "]}");
    }
    void expect_refused(const std::string& object, const std::string& part) {
        const auto file = file_with(object);
        fakes::expect_fault([&] { load_scene_file(file); }, ExitCode::BadInput, part);
    }

    fakes::TemporaryFolder folder_;
};

TEST_F(VoxelObjectTest, objectsOfOneFileAndSizeShareTheirVoxels) {
    const Scene scene =
        load_scene_file(file_with(R"({"shape":"voxels","file":"a.vox"},{"shape":"voxels","file":"./a.vox"},
                     {"shape":"voxels","file":"a.vox","voxel_size":0.5}, {"shape":"sphere"})"));
    ASSERT_EQ(scene.shapes.size(), 4u);
    EXPECT_EQ(scene.shapes[0].voxels, scene.shapes[1].voxels);
    EXPECT_NE(scene.shapes[0].voxels, scene.shapes[2].voxels);
    EXPECT_EQ(scene.shapes[3].voxels, nullptr);
    const Aabb bounds = bounds_of(scene.shapes[2], {});
    EXPECT_EQ(bounds.min, vec3(-0.5f, 0.0f, -0.5f));
    EXPECT_EQ(bounds.max, vec3(0.5f, 1.0f, 0.5f));
}

TEST_F(VoxelObjectTest, badInputIsNamed) {
    expect_refused(R"({"shape":"voxels"})", "has no \"file\"");
    expect_refused(R"({"shape":"voxels","file":"none.vox"})", "none.vox");
    expect_refused(R"({"shape":"voxels","file":"a.png"})", "no file of voxels");
    expect_refused(R"({"shape":"voxels","file":"none.glb"})", "has no \"voxelize\"");
    expect_refused(R"({"shape":"voxels","file":"none.glb","voxelize":64})", "none.glb");
    expect_refused(R"({"shape":"voxels","file":"none.glb","voxelize":64,"voxel_size":1})", "voxel_size");
    expect_refused(R"({"shape":"voxels","file":"a.vox","voxelize":64})", "leave it out");
    expect_refused(R"({"shape":"voxels","file":"a.vox","voxelize":1025})", "voxelize");
    expect_refused(R"({"shape":"voxels","file":"a.vox","voxel_size":1e9})", "out of range");
    expect_refused(R"({"shape":"sphere","voxelize":64})", "only a voxels shape");
}

}  // namespace
}  // namespace foveray::scene
