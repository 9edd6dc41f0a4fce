// Meshes made into voxels.
#include "render/scene/voxelize.h"

#include <map>

#include <gtest/gtest.h>

#include "render/scene/scene_builder.h"
#include "shaders/shared/voxels.h"
#include "tests/unit/scene/voxel_walk.h"

namespace foveray::scene {
namespace {

struct Voxel {
    vec3 center, color, normal;  // world space
};

std::vector<Voxel> voxels_in(const Voxels& v) {
    std::vector<Voxel> found;
    walk(v, [&](std::uint32_t node, std::uint32_t level, glm::uvec3 place) {
        if (level > 0) return;
        found.push_back({v.origin + v.voxel_size * (vec3(place) + 0.5f), shared::voxel_color(v.nodes[node].x),
                         shared::voxel_leaf_normal(v.nodes[node].y)});
    });
    return found;
}

/// A scene with one mesh.
Scene scene_with(Mesh mesh, Material material, const Transform& transform = {},
                 std::optional<Image> image = {}) {
    SceneBuilder builder;
    if (image) {
        Texture texture;
        texture.image = builder.add(TextureImage{"picture", *image});
        material.base_color_texture.texture = builder.add(texture);
    }
    mesh.primitives[0].material = builder.add(std::move(material));
    Node node;
    node.mesh = builder.add(std::move(mesh));
    node.local = transform;
    builder.add(node);
    return std::move(builder).build();
}

Mesh unit_rectangle() {
    Mesh mesh = make_rectangle(vec2(0.5f));
    Primitive& p = mesh.primitives[0];
    p.uv0.clear();
    for (const vec3& position : p.positions) p.uv0.emplace_back(position.x + 0.5f, position.z + 0.5f);
    return mesh;
}

TEST(Voxelize, aSphereBecomesTheCellsThatItsSurfaceCrosses) {
    const vec3 center(0.3f, -2.0f, 5.0f);
    Transform transform;
    transform.translation = center;
    const Scene scene = scene_with(make_sphere(0.7f, 128), {}, transform);
    const Voxels v = *voxelize(scene, 64);
    EXPECT_NEAR(v.voxel_size, 1.4f / 64.0f, 1e-4f);
    const float facet = 0.7f * (1.0f - std::cos(pi / 64.0f));  // how far the triangles are inside the sphere
    std::map<std::array<int, 3>, bool> there;
    for (const Voxel& voxel : voxels_in(v)) {
        vec3 nearest(0.0f), farthest(0.0f);
        for (int a = 0; a < 3; ++a) {
            const float d = std::abs(voxel.center[a] - center[a]);
            nearest[a] = std::max(d - 0.5f * v.voxel_size, 0.0f);
            farthest[a] = d + 0.5f * v.voxel_size;
        }
        EXPECT_LE(glm::length(nearest), 0.7f + 1e-4f);
        EXPECT_GE(glm::length(farthest), 0.7f - facet - 1e-4f);
        const vec3 outward = glm::normalize(voxel.center - center);
        EXPECT_GT(glm::dot(voxel.normal, outward), 0.98f);
        const glm::ivec3 cell(glm::round((voxel.center - v.origin) / v.voxel_size - 0.5f));
        there[{cell.x, cell.y, cell.z}] = true;
    }
    // Every point of the surface is in a voxel, unless the triangle and the sphere lie in different cells.
    int missing = 0, tried = 0;
    for (float a = 0.01f; a < pi; a += 0.02f) {
        for (float b = 0.0f; b < 2.0f * pi; b += 0.02f, ++tried) {
            const vec3 p = center + (0.7f - 0.5f * facet) * vec3(std::sin(a) * std::cos(b), std::cos(a),
                                                                 std::sin(a) * std::sin(b));
            const glm::ivec3 cell(glm::floor((p - v.origin) / v.voxel_size));
            missing += there.contains({cell.x, cell.y, cell.z}) ? 0 : 1;
        }
    }
    EXPECT_LT(missing, tried / 50);
}

TEST(Voxelize, aFlatFaceIsOneVoxelThick) {
    const Voxels v = *voxelize(scene_with(make_box(vec3(0.5f)), {}), 32);
    EXPECT_EQ(v.voxel_count(), 32u * 32u * 32u - 30u * 30u * 30u);
    const Voxels sheet = *voxelize(scene_with(unit_rectangle(), {}), 32);
    EXPECT_EQ(sheet.voxel_count(), 32u * 32u);
}

TEST(Voxelize, coloursAreBaseColourTimesTextureTimesVertexColour) {
    Mesh mesh = unit_rectangle();
    mesh.primitives[0].colors.assign(mesh.primitives[0].positions.size(), vec4(1.0f, 0.5f, 1.0f, 1.0f));
    Material material;
    material.base_color = {0.8f, 0.8f, 0.8f, 1.0f};
    Image image(4, 4, 4);
    for (std::uint32_t i = 0; i < 16; ++i) {
        // Left half white, right half black.
        const std::uint8_t value = i % 4 < 2 ? 255 : 0;
        for (std::uint32_t c = 0; c < 4; ++c) image.pixels[4 * i + c] = c == 3 ? 255 : value;
    }
    const Voxels v = *voxelize(scene_with(mesh, material, {}, image), 64);
    vec3 mean(0.0f);
    const std::vector<Voxel> voxels = voxels_in(v);
    for (const Voxel& voxel : voxels) {
        mean += voxel.color / static_cast<float>(voxels.size());
        const vec3 expected(0.8f, 0.4f, 0.8f);
        if (voxel.center.x > -0.35f && voxel.center.x < -0.15f) {
            EXPECT_LT(glm::length(voxel.color - expected), 0.01f);
        }
        if (voxel.center.x > 0.15f && voxel.center.x < 0.35f) {
            EXPECT_LT(glm::length(voxel.color), 0.01f);
        }
    }
    EXPECT_LT(glm::length(mean - 0.5f * vec3(0.8f, 0.4f, 0.8f)), 0.01f);
}

TEST(Voxelize, fineTexturesAreAveragedOverTheVoxel) {
    Image image(512, 512, 4);
    for (std::uint32_t i = 0; i < 512 * 512; ++i) {
        const std::uint8_t value = (i % 512 + i / 512) % 2 == 0 ? 255 : 0;
        for (std::uint32_t c = 0; c < 4; ++c) image.pixels[4 * i + c] = c == 3 ? 255 : value;
    }
    const Voxels v = *voxelize(scene_with(unit_rectangle(), {}, {}, image), 16);
    for (const Voxel& voxel : voxels_in(v)) EXPECT_NEAR(voxel.color.g, 0.5f, 0.01f);
}

TEST(Voxelize, masksLeaveHoles) {
    Image image(2, 1, 4);
    image.pixels = {255, 255, 255, 255, 255, 255, 255, 0};
    Material material;
    material.alpha_mode = AlphaMode::Mask;
    const Voxels v = *voxelize(scene_with(unit_rectangle(), material, {}, image), 64);
    EXPECT_NEAR(static_cast<double>(v.voxel_count()), 0.5 * 64 * 64, 0.02 * 64 * 64);

    material.alpha_mode = AlphaMode::Blend;
    material.base_color.a = 0.3f;
    EXPECT_FALSE(voxelize(scene_with(unit_rectangle(), material), 64).has_value());
}

TEST(Voxelize, thinAndSlantedSurfacesHaveNoGaps) {
    Transform slanted;
    slanted.rotation = glm::normalize(quat(0.9f, 0.3f, -0.2f, 0.25f));
    const Scene scene = scene_with(unit_rectangle(), {}, slanted);
    const Voxels v = *voxelize(scene, 100);
    std::map<std::array<int, 3>, bool> there;
    for (const Voxel& voxel : voxels_in(v)) {
        const glm::ivec3 cell(glm::round((voxel.center - v.origin) / v.voxel_size - 0.5f));
        there[{cell.x, cell.y, cell.z}] = true;
    }
    for (float x = -0.4995f; x < 0.5f; x += 0.0037f) {
        for (float z = -0.4995f; z < 0.5f; z += 0.0037f) {
            const vec3 p = slanted.rotation * vec3(x, 0.0f, z);
            const glm::ivec3 cell(glm::floor((p - v.origin) / v.voxel_size));
            const vec3 in_cell = glm::fract((p - v.origin) / v.voxel_size);
            if (glm::any(glm::lessThan(glm::min(in_cell, 1.0f - in_cell), vec3(1e-3f)))) continue;
            EXPECT_TRUE(there.contains({cell.x, cell.y, cell.z}));
        }
    }
}

TEST(Voxelize, nothingToVoxelizeIsSaid) {
    SceneBuilder empty;
    EXPECT_FALSE(voxelize(std::move(empty).build(), 16).has_value());
}

}  // namespace
}  // namespace foveray::scene
