// Voxel objects: a sparse octree whose every node holds the mean of what is below it.
#ifndef FOVERAY_SHARED_VOXELS_H
#define FOVERAY_SHARED_VOXELS_H

#include "shaders/shared/shapes.h"

FOVERAY_SHARED_BEGIN

#ifdef __cplusplus
using glm::abs;
using glm::normalize;
using glm::sqrt;
#endif

FOVERAY_CONST uint VOXELS_SHOW_FACES = 1u;  // voxels are shaded as cubes, not by the normal that they hold

// A link is an inner node's: which of its eight children there are (bit x + 2y + 4z) and where the first of them is.
FOVERAY_CONST uint VOXEL_LINK_INDEX_BITS = 24u;
FOVERAY_CONST uint VOXEL_MAX_NODES = 1u << 24u;
FOVERAY_CONST uint VOXEL_MAX_DEPTH = 10u;
// A ray ends at nodes no wider than this part of its cone, and at least so many levels below the root: what a coarse
// node covers is an estimate, good to 2 % for thin and round objects that are so many nodes wide.
FOVERAY_CONST float VOXEL_CONE_PART = 0.25f;
FOVERAY_CONST uint VOXEL_LEAST_DEPTH = 7u;

struct VoxelRecord {
    ShapeHeader shape;
    uint64_t links;  // uint[] of the inner nodes, which are the first of all nodes; the root is node 0
    uint64_t nodes;  // uvec2[]
    vec3 origin;     // corner of the root's cube, object space
    float voxel_size;
    vec3 box_min;  // round the voxels that there are, in voxels from the origin
    uint depth;    // the root's cube is 2^depth voxels wide
    vec3 box_max;
    uint flags;
};

// What an inner node looks like from all sides.
struct VoxelNode {
    vec3 color;     // linear, mean of what can be seen
    vec3 coverage;  // part of the rays along x, y, z through the node's cube that meet something
    vec3 sheet;     // area of the surfaces in it, as a vector along their normals that adds up with its
                    // neighbours', by the area of a side; no component is more than the coverage
    uint bent;       // 1: the surfaces in it face several ways
};

FOVERAY_INLINE vec3 voxel_color(uint word) {
    vec3 root = vec3(float(word & 255u), float(word >> 8 & 255u), float(word >> 16 & 255u)) / 255.0f;
    return root * root;
}

// Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors": octahedral.
FOVERAY_INLINE vec3 voxel_normal(uint x, uint y, float most) {
    vec3 n = vec3(float(x) / most * 2.0f - 1.0f, float(y) / most * 2.0f - 1.0f, 0.0f);
    n.z = 1.0f - abs(n.x) - abs(n.y);
    float fold = max(-n.z, 0.0f);
    n.x += n.x >= 0.0f ? -fold : fold;
    n.y += n.y >= 0.0f ? -fold : fold;
    return normalize(n);
}

// A voxel: colour 3 x 8 bits, normal 2 x 16 bits.
FOVERAY_INLINE vec3 voxel_leaf_normal(uint second) {
    return voxel_normal(second & 0xFFFFu, second >> 16, 65534.0f);
}

// An inner node: colour 3 x 8 bits, coverage z 7 bits, bent 1 bit; coverage x, y 7 bits, sheet by coverage 3 x 6 bits.
FOVERAY_INLINE VoxelNode voxel_inner(uint first, uint second) {
    VoxelNode node;
    node.color = voxel_color(first);
    vec3 root = vec3(float(second & 127u), float(second >> 7 & 127u), float(first >> 24 & 127u)) / 127.0f;
    node.coverage = root * root;
    vec3 part = vec3(float(second >> 14 & 63u), float(second >> 20 & 63u), float(second >> 26)) - vec3(31.0f);
    node.sheet = node.coverage * part / 31.0f;
    node.bent = first >> 31;
    return node;
}

FOVERAY_SHARED_END

#ifdef __cplusplus
namespace foveray::shared {
static_assert(sizeof(VoxelRecord) == 96 && offsetof(VoxelRecord, flags) == 92);
}  // namespace foveray::shared
#else
FOVERAY_ARRAY(VoxelLinks, uint);
FOVERAY_ARRAY(VoxelNodes, uvec2);
#endif

#endif
