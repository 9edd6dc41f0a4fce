// A ray's way through an octree of voxels. The including shader declares its record as `record` (VoxelRecord).
//
// Revelles et al. 2000, "An Efficient Parametric Algorithm for Octree Traversal", with the stack and the whole-number
// places of Laine and Karras 2010, "Efficient Sparse Voxel Octrees". The walk ends at single voxels, which are opaque,
// or at nodes no wider than the ray's cone, which add up.
#ifndef FOVERAY_RENDER_SHAPES_VOXEL_WALK_GLSL
#define FOVERAY_RENDER_SHAPES_VOXEL_WALK_GLSL

#include "shaders/render/vectors.glsl"
#include "shaders/shared/ray_cone.h"
#include "shaders/shared/voxels.h"

// What covers more than this covers all.
const float VOXEL_OPAQUE = 0.98;
// An empty stretch of so many nodes ends what a partly covering hit takes together: what else stands there is seen.
const float VOXEL_GAP = 16.0;

struct VoxelHit {
    float t;       // < 0: none
    float t_end;   // of a partly covering hit: where the last of it ends
    vec3 color;
    vec3 normal;   // outwards, of any length
    float alpha;
};

// What a cone sees of the nodes that it meets, added up. The surfaces in neighbouring nodes are the same surface, so
// that a ray that has met it in one does not meet it in the next: what nodes cover adds up and does not multiply
// (Vicini et al. 2021, "A Non-Exponential Transmittance Model for Volumetric Scene Representations"). What faces the
// ray and what faces away are added apart, because every ray that enters a closed body leaves it as well.
struct VoxelSum {
    float front, back;  // covered by surfaces that face the ray, and that face away
    float slight;       // by what has no side, such as twigs
    float along;        // by what stretches along the ray, such as a wall seen from its edge: the most of any node
    float alpha;
    float t;
    vec3 color;
    vec3 normal;
};

// `direction`: in voxels, unit length; `way`: through the node, voxels; `width`: the node's; `filled`: size of the node's
// part within the object's box, outside of which there is nothing. `face`: by which the ray came in; the normal of cubes whose
// sides turn all ways, such as a wall whose two sides are in the node.
void add_node(inout VoxelSum sum, VoxelNode node, vec3 direction, float way, float width, vec3 filled, vec3 face, float t) {
    vec3 slant = abs(direction);
    // The longer the way through the node the more the ray meets, as through a thin medium; but what fills its box is met
    // anyhow. Either has the same mean over all rays through the box.
    float side = width * width;
    float box = slant.x * filled.y * filled.z + slant.y * filled.z * filled.x + slant.z * filled.x * filled.y;
    float met = min(side * dot(slant, node.coverage) / box, 1.0);
    float inside = side / box * mix(way * box / (filled.x * filled.y * filled.z), 1.0, met);
    vec3 facings = -node.sheet * direction;
    float facing = facings.x + facings.y + facings.z;
    // Sides of a box face the ray and face away one by one, a plane as a whole.
    vec3 fronts = max(facings, 0.0), backs = max(-facings, 0.0);
    sum.front += inside * (node.bent == 1u ? fronts.x + fronts.y + fronts.z : max(facing, 0.0));
    sum.back += inside * (node.bent == 1u ? backs.x + backs.y + backs.z : max(-facing, 0.0));
    // The rest looks like a box. Its length along the ray, by the node's, tells whether the next node holds more of it.
    float rest = inside * dot(slant, node.coverage - abs(node.sheet));
    float stretch = sqrt(node.coverage.x * node.coverage.y * node.coverage.z) * (slant.x + slant.y + slant.z) /
                    max(dot(slant, node.coverage), 1e-6);
    stretch = clamp(2.0 * stretch - 1.0, 0.0, 1.0);
    sum.slight += (1.0 - stretch) * rest;
    sum.along = max(sum.along, stretch * rest);
    float alpha = min(max(sum.front, sum.back) + sum.slight + sum.along, 1.0);
    float gain = alpha - sum.alpha;
    sum.alpha = alpha;
    sum.color += gain * node.color;
    bool sided = (record.flags & VOXELS_SHOW_FACES) == 0 || length(node.sheet) > 0.1 * greatest(node.coverage);
    vec3 normal = sided ? node.sheet / max(length(node.sheet), 1e-6) : face;
    sum.normal += sided && facing < 0.0 ? -gain * normal : gain * normal;
    sum.t += gain * t;
}

VoxelHit mean_of(VoxelSum sum, float t_end) {
    if (sum.alpha < 1.0 / 255.0) return VoxelHit(-1.0, 0.0, vec3(0.0), vec3(0.0), 0.0);
    return VoxelHit(sum.t / sum.alpha, t_end, sum.color / sum.alpha, sum.normal,
                    sum.alpha > VOXEL_OPAQUE ? 1.0 : sum.alpha);
}

// Width of the nodes at which a ray ends at t, object units; 0 where it goes down to single voxels.
float voxel_node_width(RayCone cone, float t) {
    int coarsest = int(record.depth) - int(VOXEL_LEAST_DEPTH);
    float level = floor(log2(max(VOXEL_CONE_PART * ray_cone_width(cone, t) / record.voxel_size, 1e-6)));
    return min(level, float(coarsest)) < 1.0 ? 0.0 : exp2(min(level, float(coarsest))) * record.voxel_size;
}

// Outwards, of the side of a cube by which the ray comes in.
vec3 voxel_face(int axis, uint mirror) {
    vec3 normal = vec3(0.0);
    normal[axis] = (mirror >> axis & 1) != 0 ? 1.0 : -1.0;
    return normal;
}

// `origin`, `direction`: object space; `cone`: in object units along the ray's t. `all`: go on over gaps.
VoxelHit walk_voxels(vec3 origin, vec3 direction, RayCone cone, float t_max, bool all) {
    const VoxelHit none = VoxelHit(-1.0, 0.0, vec3(0.0), vec3(0.0), 0.0);
    float per_voxel = 1.0 / record.voxel_size;
    float side = float(1u << record.depth);
    vec3 d = direction * per_voxel;
    float speed = length(d);
    d = mix(d, vec3(1e-12 * speed), lessThan(abs(d), vec3(1e-12 * speed)));
    vec3 o = (origin - record.origin) * per_voxel;

    // The box round the voxels. The way is counted from there on, so that far origins lose no digits.
    vec3 inverse = 1.0 / d;
    vec3 to_min = (record.box_min - o) * inverse, to_max = (record.box_max - o) * inverse;
    vec3 entries = min(to_min, to_max), exits = max(to_min, to_max);
    float start = max(max(entries.x, max(entries.y, entries.z)), 0.0);
    float box_end = min(exits.x, min(exits.y, exits.z)) - start;
    float end = min(box_end, t_max - start);
    if (!(end >= 0.0)) return none;
    int axis = entries.x >= entries.y && entries.x >= entries.z ? 0 : entries.y >= entries.z ? 1 : 2;
    bool from_inside = start == 0.0;
    o += start * d;
    vec3 unit = d / speed;

    // Mirrored so that the ray goes upwards along all axes.
    uint mirror = uint(d.x < 0.0) | uint(d.y < 0.0) << 1 | uint(d.z < 0.0) << 2;
    o = mix(o, side - o, lessThan(d, vec3(0.0)));
    vec3 box_min = mix(record.box_min, side - record.box_max, lessThan(d, vec3(0.0)));
    vec3 box_max = mix(record.box_max, side - record.box_min, lessThan(d, vec3(0.0)));
    inverse = abs(inverse);
    vec3 bias = -o * inverse;  // plane p is met at p * inverse + bias

    VoxelLinks links = VoxelLinks(record.links);
    VoxelNodes nodes = VoxelNodes(record.nodes);
    uint stack[VOXEL_MAX_DEPTH];  // links of the nodes above, by their children's level
    int level = int(record.depth) - 1;
    int coarsest = max(int(record.depth) - int(VOXEL_LEAST_DEPTH), 0);
    uint link = links.at[0];
    float t = 0.0;
    ivec3 place = ivec3(greaterThanEqual(vec3(0.5 * side) * inverse + bias, vec3(0.0)));
    place = (1 - place) << level;

    VoxelSum sum = VoxelSum(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, vec3(0.0), vec3(0.0));
    float last_exit = 0.0;
    while (true) {
        int width = 1 << level;
        vec3 leaves = vec3(place + width) * inverse + bias;
        float t_exit = min(leaves.x, min(leaves.y, leaves.z));
        uint child = ((place.x >> level & 1) | (place.y >> level & 1) << 1 | (place.z >> level & 1) << 2) ^ mirror;
        uint bit = 1u << child;
        uint mask = link >> VOXEL_LINK_INDEX_BITS;
        // A ray sees nothing of the node that it starts in.
        if ((mask & bit) != 0 && t_exit > 0.0) {
            uint index = (link & (VOXEL_MAX_NODES - 1)) + bitCount(mask & (bit - 1));
            bool starts_here = from_inside && t == 0.0;
            if (level == 0) {
                if (!starts_here) {
                    uvec2 node = nodes.at[index];
                    vec3 normal = voxel_leaf_normal(node.y);
                    if ((record.flags & VOXELS_SHOW_FACES) != 0) {
                        normal = voxel_face(axis, mirror);
                    }
                    float gain = 1.0 - sum.alpha;
                    return VoxelHit(start + sum.t + gain * t, start + t, sum.color + gain * voxel_color(node.x),
                                    sum.normal + gain * normal, 1.0);
                }
            } else {
                float cone_width = ray_cone_width(cone, start + t) * per_voxel;
                if (level <= coarsest && float(width) <= VOXEL_CONE_PART * cone_width) {
                    if (!starts_here) {
                        if (!all && sum.alpha > 0.0 && (t - last_exit) * speed > VOXEL_GAP * float(width)) break;
                        uvec2 node = nodes.at[index];
                        vec3 filled = min(vec3(place + width), box_max) - max(vec3(place), box_min);
                        float way = (min(t_exit, box_end) - t) * speed;
                        add_node(sum, voxel_inner(node.x, node.y), unit, way, float(width), filled,
                                 voxel_face(axis, mirror), 0.5 * (t + t_exit));
                        last_exit = t_exit;
                        if (sum.alpha > VOXEL_OPAQUE) break;
                    }
                } else {
                    stack[level] = link;
                    link = links.at[index];
                    --level;
                    ivec3 half_way = place + (1 << level);
                    place += ivec3(lessThanEqual(vec3(half_way) * inverse + bias, vec3(t))) << level;
                    continue;
                }
            }
        }
        // On to the next cube.
        if (t_exit >= end) break;
        t = max(t_exit, 0.0);
        axis = leaves.x <= t_exit ? 0 : leaves.y <= t_exit ? 1 : 2;
        int before = place[axis];
        int after = before + width;
        int rise = findMSB(before ^ after);
        if (rise >= int(record.depth)) break;
        place[axis] = after;
        if (rise > level) {
            level = rise;
            link = stack[level];
            place = place >> level << level;
        }
    }
    VoxelHit hit = mean_of(sum, start + last_exit);
    if (hit.t >= 0.0) hit.t += start;
    return hit;
}

#endif
