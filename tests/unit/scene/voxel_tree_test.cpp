// The octree of voxels against sums over the voxels themselves.
#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "render/scene/voxels.h"
#include "shaders/shared/voxels.h"
#include "tests/fakes/random.h"
#include "tests/unit/scene/voxel_walk.h"

namespace foveray::scene {
namespace {

constexpr std::uint32_t side = 32, depth = 5;

struct PlaceLess {
    bool operator()(glm::uvec3 a, glm::uvec3 b) const { return morton_of(a) < morton_of(b); }
};
using Cells = std::map<glm::uvec3, VoxelSample, PlaceLess>;

Cells random_cells(std::uint32_t seed, int count) {
    fakes::Random random(seed);
    Cells cells;
    cells[{0, 0, side - 1}] = {morton_of({0, 0, side - 1}), 1.0f, vec3(0.5f), vec3(0, 0, 1)};
    for (int i = 0; i < count; ++i) {
        const glm::uvec3 place(random.below(side), random.below(side), random.below(side));
        const vec3 normal = glm::normalize(random.vector(-0.5f, 0.5f));
        cells[place] = {morton_of(place), 1.0f, random.vector(0, 1), normal};
    }
    return cells;
}

Voxels tree_of(const Cells& cells) {
    std::vector<VoxelSample> samples;
    for (const auto& [place, sample] : cells) samples.push_back(sample);
    std::ranges::reverse(samples);
    Voxels voxels;
    voxels.voxel_size = 1.0f;
    EXPECT_TRUE(build_tree(samples, voxels));
    return voxels;
}

/// The exact part of the columns along each axis, of a cube's voxels, that have something in them.
vec3 coverage_of(const Cells& cells, std::uint32_t level, glm::uvec3 corner) {
    vec3 coverage(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> columns;
        for (const auto& [place, sample] : cells) {
            if ((place >> level) != (corner >> level)) continue;
            columns.insert({place[(axis + 1) % 3], place[(axis + 2) % 3]});
        }
        coverage[axis] = static_cast<float>(columns.size()) / static_cast<float>(1u << 2 * level);
    }
    return coverage;
}

TEST(VoxelTree, holdsEveryVoxelOnceWhereItIs) {
    const Cells cells = random_cells(1, 900);
    const Voxels voxels = tree_of(cells);
    ASSERT_EQ(voxels.depth, depth);
    EXPECT_EQ(voxels.voxel_count(), cells.size());
    EXPECT_EQ(voxels.links.size(), voxels.level_begin[depth]);
    std::size_t found = 0;
    walk(voxels, [&](std::uint32_t node, std::uint32_t level, glm::uvec3 place) {
        EXPECT_GE(node, voxels.level_begin[depth - level]);
        EXPECT_LT(node, voxels.level_begin[depth - level + 1]);
        if (level > 0) return;
        ++found;
        ASSERT_TRUE(cells.contains(place));
        const VoxelSample& sample = cells.at(place);
        EXPECT_LT(glm::length(shared::voxel_color(voxels.nodes[node].x) - sample.color), 0.008f);
        EXPECT_LT(glm::length(shared::voxel_leaf_normal(voxels.nodes[node].y) - sample.normal), 1e-4f);
    });
    EXPECT_EQ(found, cells.size());
}

TEST(VoxelTree, nodesAreTheMeanOfWhatIsBelow) {
    const Cells cells = random_cells(2, 400);
    const Voxels voxels = tree_of(cells);
    // Colours from voxels up, each node the coverage-weighted mean of its children.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<vec3, vec3>> exact;  // colour, coverage
    for (const auto& [place, sample] : cells) {
        exact[{0, sample.morton}] = {sample.color, vec3(1.0f)};
    }
    for (std::uint32_t level = 1; level <= depth; ++level) {
        std::map<std::uint32_t, std::pair<vec3, float>> sums;
        for (const auto& [key, value] : exact) {
            if (key.first != level - 1) continue;
            const float weight = (value.second.x + value.second.y + value.second.z) / 3.0f;
            auto& [color, total] = sums[key.second >> 3];
            color += weight * value.first;
            total += weight;
        }
        for (const auto& [morton, sum] : sums) {
            const glm::uvec3 corner = place_of(morton) << level;
            exact[{level, morton}] = {sum.first / sum.second, coverage_of(cells, level, corner)};
        }
    }
    walk(voxels, [&](std::uint32_t node, std::uint32_t level, glm::uvec3 place) {
        if (level == 0) return;
        const shared::VoxelNode n = shared::voxel_inner(voxels.nodes[node].x, voxels.nodes[node].y);
        const auto& [color, coverage] = exact.at({level, morton_of(place >> level)});
        EXPECT_LT(glm::length(n.color - color), 0.008f) << "level " << level;
        for (int a = 0; a < 3; ++a) EXPECT_NEAR(n.coverage[a], coverage[a], 0.009f) << "level " << level;
        vec3 area(0.0f);
        for (const auto& [at, sample] : cells) {
            if ((at >> level) != (place >> level)) continue;
            const vec3 size = glm::abs(sample.normal);
            area += sample.normal / (size.x + size.y + size.z);
        }
        area = glm::clamp(area / static_cast<float>(1u << 2 * level), -coverage, coverage);
        for (int a = 0; a < 3; ++a) EXPECT_NEAR(n.sheet[a], area[a], 0.02f) << "level " << level;
    });
}

TEST(VoxelTree, samplesInOneVoxelAreAveragedByWeight) {
    Voxels voxels;
    voxels.voxel_size = 1.0f;
    const std::uint32_t at = morton_of({1, 0, 1});
    ASSERT_TRUE(build_tree(
        {{at, 3.0f, vec3(1, 0, 0), vec3(0, 1, 0)}, {at, 1.0f, vec3(0, 0, 1), vec3(1, 0, 0)}}, voxels));
    ASSERT_EQ(voxels.voxel_count(), 1u);
    const vec3 color = shared::voxel_color(voxels.nodes.back().x);
    EXPECT_NEAR(color.r, 0.75f, 0.004f);
    EXPECT_NEAR(color.b, 0.25f, 0.004f);
    EXPECT_LT(glm::length(shared::voxel_leaf_normal(voxels.nodes.back().y) - glm::normalize(vec3(1, 3, 0))),
              1e-4f);
}

TEST(VoxelTree, largestGridIsTenLevelsDeep) {
    Voxels voxels;
    voxels.voxel_size = 1.0f;
    ASSERT_TRUE(build_tree({{morton_of({1023, 1023, 1023}), 1.0f, vec3(1), vec3(0, 1, 0)},
                            {morton_of({0, 0, 0}), 1.0f, vec3(1), vec3(0, 1, 0)}},
                           voxels));
    EXPECT_EQ(voxels.depth, shared::VOXEL_MAX_DEPTH);
    EXPECT_EQ(voxels.nodes.size(), 21u);
}

TEST(VoxelTree, aSolidSurfaceTakesLessThanFourteenBytesAVoxel) {
    // A sphere's shell, 256 voxels wide: of surfaces, each level has a fourth of the nodes of the one below.
    std::vector<VoxelSample> samples;
    for (std::uint32_t x = 0; x < 256; ++x) {
        for (std::uint32_t y = 0; y < 256; ++y) {
            for (std::uint32_t z = 0; z < 256; ++z) {
                const vec3 p = vec3(x, y, z) + 0.5f - 128.0f;
                if (std::abs(glm::length(p) - 126.0f) > 0.7f) continue;
                samples.push_back({morton_of({x, y, z}), 1.0f, vec3(0.5f), glm::normalize(p)});
            }
        }
    }
    Voxels voxels;
    voxels.voxel_size = 1.0f;
    ASSERT_TRUE(build_tree(samples, voxels));
    const double each = static_cast<double>(voxels.bytes()) / static_cast<double>(voxels.voxel_count());
    EXPECT_EQ(voxels.voxel_count(), samples.size());
    EXPECT_LT(each, 14.0);
    EXPECT_GT(each, 8.0);
}

}  // namespace
}  // namespace foveray::scene
