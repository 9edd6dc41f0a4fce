#include "render/reference/bvh.h"

#include <random>

#include <gtest/gtest.h>

namespace foveray::reference {
namespace {

constexpr Triangle right_triangle{dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)};

TEST(Intersect, givesDistanceAndBarycentrics) {
    TriangleHit hit;
    ASSERT_TRUE(intersect({.origin = {0.25, 0.5, 3}, .direction = {0, 0, -2}}, right_triangle, hit));
    EXPECT_DOUBLE_EQ(hit.distance, 1.5);
    EXPECT_DOUBLE_EQ(hit.u, 0.25);
    EXPECT_DOUBLE_EQ(hit.v, 0.5);
}

TEST(Intersect, missesOutsideAndBehindAndParallel) {
    TriangleHit hit;
    EXPECT_FALSE(intersect({.origin = {0.6, 0.6, 1}, .direction = {0, 0, -1}}, right_triangle, hit));
    EXPECT_FALSE(intersect({.origin = {0.2, 0.2, 1}, .direction = {0, 0, 1}}, right_triangle, hit));
    EXPECT_FALSE(intersect({.origin = {0.2, 0.2, 1}, .direction = {1, 0, 0}}, right_triangle, hit));
    EXPECT_FALSE(
        intersect({.origin = {0.2, 0.2, 1}, .direction = {0, 0, -1}, .farthest = 0.5}, right_triangle, hit));
    EXPECT_FALSE(
        intersect({.origin = {0.2, 0.2, 1}, .direction = {0, 0, -1}, .nearest = 1.5}, right_triangle, hit));
}

TEST(Bvh, findsWhatATestOfEveryTriangleFinds) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto point = [&] { return dvec3(number(random), number(random), number(random)); };
    std::vector<Triangle> triangles;
    for (int i = 0; i < 400; ++i) {
        const dvec3 p = point();
        triangles.push_back({p, p + 0.3 * point(), p + 0.3 * point()});
    }
    const Bvh bvh(triangles);
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
        const Ray ray{.origin = 2.0 * point(), .direction = i % 5 ? point() : dvec3(0, 0, i % 2 ? 1 : -1)};
        double all = ray.farthest, found = ray.farthest;
        TriangleHit hit;
        for (const Triangle& triangle : triangles) {
            if (intersect(ray, triangle, hit)) all = std::min(all, hit.distance);
        }
        bvh.visit_hits(ray, [&](const TriangleHit& h) { return found = std::min(found, h.distance); });
        EXPECT_EQ(found, all);
        hits += all < ray.farthest;
    }
    EXPECT_GT(hits, 50);
}

TEST(Bvh, withoutTrianglesHitsNothing) {
    Bvh({}).visit_hits({}, [](const TriangleHit& hit) {
        ADD_FAILURE();
        return hit.distance;
    });
}

}  // namespace
}  // namespace foveray::reference
