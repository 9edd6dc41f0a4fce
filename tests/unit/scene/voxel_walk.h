#pragma once

#include "render/scene/voxels.h"
#include "shaders/shared/voxels.h"

namespace foveray::scene {

/// Calls act(node index, level, place of its lowest corner) for every node of the tree, parents first. Level
/// 0 are the voxels; places are counted in voxels.
template <class Act>
void walk(const Voxels& voxels, const Act& act, std::uint32_t node, std::uint32_t level, glm::uvec3 place) {
    act(node, level, place);
    if (level == 0) return;
    const std::uint32_t link = voxels.links[node];
    std::uint32_t child = link & (shared::VOXEL_MAX_NODES - 1);
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
        if ((link >> shared::VOXEL_LINK_INDEX_BITS >> octant & 1) == 0) continue;
        const glm::uvec3 step(octant & 1, octant >> 1 & 1, octant >> 2);
        walk(voxels, act, child++, level - 1, place + (step << (level - 1)));
    }
}
template <class Act>
void walk(const Voxels& voxels, const Act& act) {
    walk(voxels, act, 0, voxels.depth, glm::uvec3(0));
}

}  // namespace foveray::scene
