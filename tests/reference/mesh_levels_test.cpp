#include "render/scene/mesh_levels.h"

#include <algorithm>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "base/headset_profile.h"
#include "render/scene/load_scene.h"
#include "render/scene/scene_builder.h"

namespace foveray::reference {
namespace {

using Indices = std::vector<std::uint32_t>;

double distance_to_triangle(dvec3 p, dvec3 a, dvec3 b, dvec3 c) {
    const dvec3 n = glm::cross(b - a, c - a);
    const auto beside = [&](dvec3 from, dvec3 to) {
        return glm::dot(glm::cross(to - from, p - from), n) < 0.0;
    };
    const auto to_edge = [&](dvec3 from, dvec3 to) {
        const dvec3 edge = to - from;
        const double t =
            glm::clamp(glm::dot(p - from, edge) / std::max(glm::dot(edge, edge), 1e-300), 0.0, 1.0);
        return glm::distance(p, from + t * edge);
    };
    if (glm::dot(n, n) > 0.0 && !beside(a, b) && !beside(b, c) && !beside(c, a)) {
        return std::abs(glm::dot(p - a, glm::normalize(n)));
    }
    return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

/// Greatest distance from points of one of the surfaces to the other.
double deviation(const std::vector<vec3>& positions, const Indices& from, const Indices& to,
                 std::mt19937& random) {
    constexpr int points = 150;
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double worst = 0.0;
    for (int i = 0; i < points; ++i) {
        const std::size_t t = 3 * (random() % (from.size() / 3));
        double u = unit(random), v = unit(random);
        if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
        const dvec3 a(positions[from[t]]), b(positions[from[t + 1]]), c(positions[from[t + 2]]);
        const dvec3 p = a + u * (b - a) + v * (c - a);
        double nearest = 1e30;
        for (std::size_t k = 0; k < to.size(); k += 3) {
            nearest = std::min(nearest,
                               distance_to_triangle(p, dvec3(positions[to[k]]), dvec3(positions[to[k + 1]]),
                                                    dvec3(positions[to[k + 2]])));
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

std::size_t triangle_count(const std::vector<Indices>& primitives) {
    std::size_t count = 0;
    for (const Indices& indices : primitives) count += indices.size() / 3;
    return count;
}

TEST(MeshLevels, KeepToTheirErrors) {
    std::mt19937 random(1);
    double worst = 0.0;
    std::size_t meshes = 0;
    for (const char* file : {"scenes/herr.json", "models/torus_knot.glb", "models/chrome_sphere.glb"}) {
        const scene::Scene scene = scene::load_scene(assets_folder() / file);
        for (const scene::Mesh& mesh : scene.meshes) {
            const std::vector<scene::MeshLevel> levels = scene::make_mesh_levels(mesh);
            meshes += !levels.empty();
            for (std::size_t level = 0; level < levels.size(); level += 2) {
                for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
                    const Indices &full = mesh.primitives[i].indices, &coarse = levels[level].indices[i];
                    if (coarse.size() == full.size()) continue;
                    const double d = std::max(deviation(mesh.primitives[i].positions, full, coarse, random),
                                              deviation(mesh.primitives[i].positions, coarse, full, random));
                    EXPECT_LE(d, double{levels[level].error}) << mesh.name << " level " << level + 1;
                    worst = std::max(worst, d / double{levels[level].error});
                }
            }
        }
    }
    EXPECT_GE(meshes, 6u);
    EXPECT_GT(worst, 0.2) << "the errors say nothing";
    std::cout << "greatest deviation, part of the error given: " << worst << '\n';
}

TEST(MeshLevels, HalveTheTriangles) {
    scene::SceneBuilder builder;
    const scene::Mesh sphere = scene::make_sphere(0.5f, 64);
    const std::vector<scene::MeshLevel> levels = scene::make_mesh_levels(sphere);
    ASSERT_EQ(levels.size(), 4u);
    std::size_t before = sphere.primitives[0].indices.size() / 3;
    float error = 0.0f;
    for (const scene::MeshLevel& level : levels) {
        const std::size_t now = triangle_count(level.indices);
        EXPECT_GE(now, before * 2 / 5);
        EXPECT_LE(now, before * 3 / 4);
        EXPECT_GT(level.error, error);
        before = now, error = level.error;
    }
    EXPECT_LT(levels[0].error, 0.005f);
}

TEST(MeshLevels, LeaveAloneWhatTheyCouldNotShow) {
    EXPECT_TRUE(scene::make_mesh_levels(scene::make_sphere(0.5f, 16)).empty()) << "few triangles";
    scene::Mesh colored = scene::make_sphere(0.5f, 64);
    colored.primitives[0].colors.resize(colored.primitives[0].positions.size(), vec4(1.0f));
    EXPECT_FALSE(scene::make_mesh_levels(colored).empty());
    colored.primitives[0].colors[7].r = 0.5f;
    EXPECT_TRUE(scene::make_mesh_levels(colored).empty());
    scene::Mesh morphed = scene::make_sphere(0.5f, 64);
    morphed.primitives[0].morph_targets.emplace_back();
    EXPECT_TRUE(scene::make_mesh_levels(morphed).empty());
    // Beside one that cannot be simplified, another is.
    colored.primitives.push_back(scene::make_sphere(0.3f, 64).primitives[0]);
    const std::vector<scene::MeshLevel> levels = scene::make_mesh_levels(colored);
    ASSERT_FALSE(levels.empty());
    EXPECT_EQ(levels[0].indices[0], colored.primitives[0].indices);
    EXPECT_LT(levels[0].indices[1].size(), colored.primitives[1].indices.size());
}

}  // namespace
}  // namespace foveray::reference
