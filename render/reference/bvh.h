#pragma once

#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "base/math.h"

/// The simple, slow answer to the queries that the GPU path answers, for tests: double precision, no tricks.
namespace foveray::reference {

struct Ray {
    dvec3 origin{0.0};
    dvec3 direction{0.0, 0.0, -1.0};  // distances count in its length
    double nearest = 0.0;
    double farthest = std::numeric_limits<double>::infinity();
};

struct TriangleHit {
    double distance = 0.0;
    double u = 0.0, v = 0.0;  // barycentric weights of corners 1 and 2
    std::size_t triangle = 0;
};

using Triangle = std::array<dvec3, 3>;

/// Möller and Trumbore 1997, both sides. False when parallel or outside (nearest, farthest).
bool intersect(const Ray& ray, const Triangle& triangle, TriangleHit& hit);

/// A bounding volume hierarchy split at the median of the widest axis.
class Bvh {
  public:
    explicit Bvh(std::vector<Triangle> triangles);

    /// Calls `visit` for triangles that the ray meets, in no order. It returns the distance beyond which no
    /// more hits are wanted.
    void visit_hits(const Ray& ray, const std::function<double(const TriangleHit&)>& visit) const;

  private:
    struct Box {
        dvec3 min{std::numeric_limits<double>::infinity()};
        dvec3 max{-std::numeric_limits<double>::infinity()};
    };
    struct BvhNode {
        Box box;
        std::size_t first = 0, count = 0;  // of order_; inner nodes have count 0
        std::size_t left = 0, right = 0;
    };

    std::size_t build(std::size_t first, std::size_t count);

    std::vector<Triangle> triangles_;
    std::vector<std::size_t> order_;
    std::vector<BvhNode> nodes_;
};

}  // namespace foveray::reference
