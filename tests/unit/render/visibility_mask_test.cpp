#include "render/visibility_mask.h"

#include <bit>

#include <gtest/gtest.h>

namespace foveray::render {
namespace {

constexpr std::uint32_t size = shared::HIDDEN_MASK_SIZE;
const Fov quarter{-pi / 4, pi / 4, pi / 4, -pi / 4};  // tangents -1 … 1

bool hidden(const std::vector<std::uint32_t>& words, std::uint32_t x, std::uint32_t y) {
    const std::uint32_t cell = y * size + x;
    return (words[cell / 32] >> (cell % 32) & 1u) != 0;
}

std::size_t count(const std::vector<std::uint32_t>& words) {
    std::size_t n = 0;
    for (std::uint32_t word : words) n += static_cast<std::size_t>(std::popcount(word));
    return n;
}

TEST(VisibilityMask, NothingIsHiddenWithoutAMesh) { EXPECT_TRUE(hidden_cells({}, quarter).empty()); }

TEST(VisibilityMask, HidesTheTopLeftQuarter) {
    // Two triangles of opposite winding; their common diagonal crosses cells that both share.
    const HiddenMesh mesh{.vertices = {{-1, 0}, {0, 0}, {0, 1}, {-1, 1}}, .indices = {0, 1, 2, 0, 3, 2}};
    const auto words = hidden_cells(mesh, quarter);
    ASSERT_EQ(words.size(), hidden_mask_words);
    EXPECT_EQ(count(words), std::size_t{size} * size / 4);
    EXPECT_TRUE(hidden(words, 0, 0));
    EXPECT_TRUE(hidden(words, size / 2 - 1, size / 2 - 1));
    EXPECT_FALSE(hidden(words, size / 2, 0));
    EXPECT_FALSE(hidden(words, 0, size / 2));
}

TEST(VisibilityMask, PartlyCoveredCellsStayVisible) {
    const float cell = 2.0f / static_cast<float>(size);
    const float edge = -1.0f + 3.5f * cell;
    const HiddenMesh mesh{.vertices = {{-2, -2}, {edge, -2}, {edge, 2}, {-2, 2}},
                          .indices = {0, 1, 2, 0, 2, 3}};
    const auto words = hidden_cells(mesh, quarter);
    EXPECT_TRUE(hidden(words, 2, 64));
    EXPECT_FALSE(hidden(words, 3, 64));
    EXPECT_EQ(count(words), std::size_t{size} * 3);
}

TEST(VisibilityMask, OverlappingTrianglesDoNotCountTwice) {
    const float cell = 2.0f / static_cast<float>(size);
    // Twice the same half of a cell: the other half is still seen.
    const float left = -1.0f, right = -1.0f + 0.5f * cell, top = 1.0f, bottom = 1.0f - cell;
    const HiddenMesh mesh{.vertices = {{left, bottom}, {right, bottom}, {right, top}, {left, top}},
                          .indices = {0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 2, 3}};
    EXPECT_TRUE(hidden_cells(mesh, quarter).empty());
}

TEST(VisibilityMask, FollowsTheFieldOfView) {
    const HiddenMesh mesh{.vertices = {{-1, -1}, {0, -1}, {0, 1}, {-1, 1}}, .indices = {0, 1, 2, 0, 2, 3}};
    const Fov right_half{0.0f, pi / 4, pi / 4, -pi / 4};
    EXPECT_TRUE(hidden_cells(mesh, right_half).empty());
    EXPECT_EQ(count(hidden_cells(mesh, quarter)), std::size_t{size} * size / 2);
}

}  // namespace
}  // namespace foveray::render
