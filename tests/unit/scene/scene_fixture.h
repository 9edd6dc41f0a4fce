#pragma once

#include <gtest/gtest.h>

#include "render/scene/animator.h"
#include "render/scene/gltf_loader.h"
#include "render/scene/scene_builder.h"
#include "tests/fakes/gltf_builder.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray::scene {

/// Loads glTF files that a test builds.
class GltfTest : public testing::Test {
  protected:
    Scene load_file(const std::filesystem::path& file, const GltfModel::Use& use = {}) {
        SceneBuilder builder;
        GltfModel(builder, file).instantiate(use);
        return std::move(builder).build();
    }
    Scene load(const fakes::GltfBuilder& gltf, const GltfModel::Use& use = {}) {
        return load_file(folder_.write("model.gltf", gltf.text()), use);
    }
    /// The only primitive of the first mesh.
    Primitive load_primitive(const fakes::GltfBuilder& gltf) {
        const Scene scene = load(gltf);
        EXPECT_EQ(scene.meshes.size(), 1u);
        EXPECT_EQ(scene.meshes[0].primitives.size(), 1u);
        return scene.meshes[0].primitives[0];
    }

    fakes::TemporaryFolder folder_;
};

inline void expect_near(vec3 a, vec3 b, float tolerance = 1e-5f) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

inline vec3 transform(const mat4& m, vec3 p) { return vec3(m * vec4(p, 1.0f)); }

}  // namespace foveray::scene
