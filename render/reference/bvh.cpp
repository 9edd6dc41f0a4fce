#include "render/reference/bvh.h"

#include <algorithm>
#include <numeric>

namespace foveray::reference {

bool intersect(const Ray& ray, const Triangle& triangle, TriangleHit& hit) {
    const dvec3 e1 = triangle[1] - triangle[0], e2 = triangle[2] - triangle[0];
    const dvec3 p = glm::cross(ray.direction, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0.0) return false;
    const dvec3 s = ray.origin - triangle[0];
    const dvec3 q = glm::cross(s, e1);
    hit.u = glm::dot(s, p) / determinant;
    hit.v = glm::dot(ray.direction, q) / determinant;
    hit.distance = glm::dot(e2, q) / determinant;
    return hit.u >= 0.0 && hit.v >= 0.0 && hit.u + hit.v <= 1.0 && hit.distance > ray.nearest &&
           hit.distance < ray.farthest;
}

Bvh::Bvh(std::vector<Triangle> triangles) : triangles_(std::move(triangles)), order_(triangles_.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    if (!triangles_.empty()) build(0, triangles_.size());
}

std::size_t Bvh::build(std::size_t first, std::size_t count) {
    constexpr std::size_t leaf_size = 4;
    Box box, centers;
    const auto center = [&](std::size_t id) {
        return (triangles_[id][0] + triangles_[id][1] + triangles_[id][2]) / 3.0;
    };
    for (std::size_t i = first; i < first + count; ++i) {
        for (const dvec3& corner : triangles_[order_[i]]) {
            box.min = glm::min(box.min, corner), box.max = glm::max(box.max, corner);
        }
        const dvec3 c = center(order_[i]);
        centers.min = glm::min(centers.min, c), centers.max = glm::max(centers.max, c);
    }
    const std::size_t id = nodes_.size();
    nodes_.push_back({box, first, count, 0, 0});
    if (count <= leaf_size) return id;

    const dvec3 extent = centers.max - centers.min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
    const std::size_t half = count / 2;
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half),
                     begin + static_cast<std::ptrdiff_t>(count),
                     [&](std::size_t a, std::size_t b) { return center(a)[axis] < center(b)[axis]; });
    const std::size_t left = build(first, half);
    const std::size_t right = build(first + half, count - half);
    nodes_[id].count = 0;
    nodes_[id].left = left;
    nodes_[id].right = right;
    return id;
}

void Bvh::visit_hits(const Ray& ray, const std::function<double(const TriangleHit&)>& visit) const {
    if (nodes_.empty()) return;
    Ray open = ray;
    const auto meets = [&](const Box& box) {
        double enter = open.nearest, leave = open.farthest;
        for (int axis = 0; axis < 3; ++axis) {
            if (open.direction[axis] == 0.0) {
                if (open.origin[axis] < box.min[axis] || open.origin[axis] > box.max[axis]) return false;
                continue;
            }
            const double a = (box.min[axis] - open.origin[axis]) / open.direction[axis];
            const double b = (box.max[axis] - open.origin[axis]) / open.direction[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter <= leave * (1.0 + 1e-12) + 1e-12;
    };
    std::vector<std::size_t> stack{0};
    while (!stack.empty()) {
        const BvhNode& node = nodes_[stack.back()];
        stack.pop_back();
        if (!meets(node.box)) continue;
        if (node.count == 0) {
            stack.push_back(node.left);
            stack.push_back(node.right);
        }
        for (std::size_t i = node.first; i < node.first + node.count; ++i) {
            TriangleHit hit;
            hit.triangle = order_[i];
            if (intersect(open, triangles_[order_[i]], hit)) open.farthest = visit(hit);
        }
    }
}

}  // namespace foveray::reference
