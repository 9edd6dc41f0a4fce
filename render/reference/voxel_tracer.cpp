#include "render/reference/voxel_tracer.h"

#include <algorithm>
#include <cmath>

namespace foveray::reference {
namespace {

/// A voxel that turns away by more than this (cosine) is seen from inside; of less the ray sees the rim.
constexpr double rim = 0.25;

/// Of a leaf's first word: three bytes, each the square root of a linear component.
vec3 color_of(std::uint32_t word) {
    const vec3 root = vec3(word & 255u, word >> 8 & 255u, word >> 16 & 255u) / 255.0f;
    return root * root;
}

/// Of a leaf's second word: two halves of 16 bits, an octahedron's coordinates -1 to 1 (Cigolle et al. 2014).
dvec3 normal_of(std::uint32_t word) {
    const double u = (word & 0xFFFFu) / 32767.0 - 1.0, v = (word >> 16) / 32767.0 - 1.0;
    dvec3 normal(u, v, 1.0 - std::abs(u) - std::abs(v));
    if (normal.z < 0.0) {
        normal.x = std::copysign(1.0 - std::abs(v), u);
        normal.y = std::copysign(1.0 - std::abs(u), v);
    }
    return glm::normalize(normal);
}

struct Nearest {
    double distance;
    std::uint32_t node = 0;
    dvec3 face{0.0};
};

/// A ray in voxels from the corner of the root's cube.
class Descent {
  public:
    Descent(const scene::Voxels& voxels, const Ray& ray) : voxels_(voxels), ray_(ray) {}

    /// Looks for a nearer voxel in the cube of `width` at `low`, which is that node's.
    void visit(std::uint32_t node, const dvec3& low, std::uint32_t width, Nearest& nearest) const {
        dvec3 face(0.0);
        double enters = -std::numeric_limits<double>::infinity(), leaves = -enters;
        for (int axis = 0; axis < 3; ++axis) {
            const double d = ray_.direction[axis], high = low[axis] + width;
            if (d == 0.0) {
                if (ray_.origin[axis] < low[axis] || ray_.origin[axis] > high) return;
                continue;
            }
            const double in = ((d > 0.0 ? low[axis] : high) - ray_.origin[axis]) / d;
            const double out = ((d > 0.0 ? high : low[axis]) - ray_.origin[axis]) / d;
            if (in > enters) {
                enters = in;
                face = dvec3(0.0);
                face[axis] = d > 0.0 ? -1.0 : 1.0;
            }
            leaves = std::min(leaves, out);
        }
        if (enters >= leaves || leaves <= ray_.nearest || enters >= nearest.distance) return;
        if (width == 1) {
            if (enters > ray_.nearest) nearest = {enters, node, face};
            return;
        }
        const std::uint32_t link = voxels_.links[node], mask = link >> 24;
        std::uint32_t child = link & 0xFFFFFFu;
        const std::uint32_t half = width / 2;
        for (std::uint32_t i = 0; i < 8; ++i) {
            if ((mask >> i & 1u) == 0) continue;
            visit(child++, low + double(half) * dvec3(i & 1, i >> 1 & 1, i >> 2), half, nearest);
        }
    }

  private:
    const scene::Voxels& voxels_;
    const Ray& ray_;
};

}  // namespace

std::optional<Crossing> first_voxel(const scene::Voxels& voxels, const Ray& ray) {
    Ray in_voxels = ray;
    in_voxels.origin = (ray.origin - dvec3(voxels.origin)) / double{voxels.voxel_size};
    in_voxels.direction = ray.direction / double{voxels.voxel_size};
    Nearest nearest{ray.farthest};
    Descent(voxels, in_voxels).visit(0, dvec3(0.0), 1u << voxels.depth, nearest);
    if (nearest.distance >= ray.farthest) return std::nullopt;
    const glm::uvec2 node = voxels.nodes[nearest.node];
    Crossing crossing;
    crossing.distance = nearest.distance;
    crossing.normal = voxels.show_faces ? nearest.face : normal_of(node.y);
    crossing.inside = glm::dot(crossing.normal, glm::normalize(ray.direction)) > rim;
    crossing.tint = color_of(node.x);
    return crossing;
}

}  // namespace foveray::reference
