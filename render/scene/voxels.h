#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/mesh.h"

namespace foveray::scene {

/// An object of small cubes: a sparse octree that holds, for every cube of 1, 2, 4, … voxels a side with
/// anything in it, what that looks like on average (after Meagher 1980 and Williams 1983, as in HERR 2.2.1).
/// The arrays are the GPU's (shaders/shared/voxels.h).
struct Voxels {
    std::vector<std::uint32_t> links;  // of inner nodes: mask of children << 24 | the first child's index
    std::vector<glm::uvec2> nodes;     // all nodes, from the root on level by level, in Morton order
    std::vector<std::uint32_t> level_begin;  // first node of each level, the root's first; then nodes.size()
    std::uint32_t depth = 0;                 // the root is 2^depth voxels wide
    vec3 origin{0.0f};                       // lowest corner of the root's cube, object space
    float voxel_size = 0.0f;
    vec3 box_min{0.0f}, box_max{0.0f};  // round all voxels, in voxels from the origin
    bool show_faces = false;            // shaded as cubes instead of smoothly

    std::size_t voxel_count() const { return nodes.size() - level_begin[depth]; }
    /// What the GPU keeps.
    std::size_t bytes() const {
        return links.size() * sizeof(std::uint32_t) + nodes.size() * sizeof(glm::uvec2);
    }
    Aabb bounds() const { return {origin + voxel_size * box_min, origin + voxel_size * box_max}; }
};

/// Something in one voxel; several samples may fall into the same.
struct VoxelSample {
    std::uint32_t morton = 0;  // of the voxel's place, 10 bits each
    float weight = 1.0f;       // its share of the voxel's colour and normal, more than 0
    vec3 color{0.0f};          // linear, 0 to 1
    vec3 normal{0.0f};         // unit, outwards
};

constexpr std::uint32_t largest_voxel_grid = 1024;  // voxels a side

std::uint32_t morton_of(glm::uvec3 place);
glm::uvec3 place_of(std::uint32_t morton);

/// Sorts by place and makes one of those in the same voxel.
void merge_samples(std::vector<VoxelSample>& samples);

/// Builds the tree over at least one sample; `voxels` brings origin, size and show_faces. Coverage is counted
/// exactly, by projecting all voxels below a node along each axis; colours are means of eight, weighted by
/// coverage. False: there would be more than 2^24 nodes.
bool build_tree(std::vector<VoxelSample> samples, Voxels& voxels);

/// Bits of one node, for build_tree and tests. Values as in shared::VoxelNode.
glm::uvec2 pack_voxel(vec3 color, vec3 normal);
glm::uvec2 pack_inner_node(vec3 color, vec3 coverage, vec3 sheet, bool bent);

}  // namespace foveray::scene
