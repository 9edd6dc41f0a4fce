// What the reference tracer finds by marching and walking, where a closed form tells the same.
#include <random>

#include <gtest/gtest.h>

#include "render/reference/shape_tracer.h"
#include "render/reference/tracer.h"
#include "render/scene/scene_builder.h"
#include "tests/fakes/expect_fault.h"

namespace foveray::reference {
namespace {

using scene::Shape;
using scene::ShapeKind;

Shape shape_of(ShapeKind kind) {
    Shape shape;
    shape.kind = kind;
    shape.values = scene::default_values(scene::shape_kind(kind).parameters);
    return shape;
}

std::vector<Ray> rays(double reach) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    std::vector<Ray> result(100);
    for (Ray& ray : result) {
        ray.origin = reach * dvec3(number(random), number(random), number(random));
        ray.direction = dvec3(number(random), number(random), number(random)) - 0.3 * ray.origin;
    }
    return result;
}

/// Both give the same crossings, but for rays that touch an edge. Returns how many crossings there were.
int expect_same(const Shape& a, const Shape& b, double tolerance) {
    int found = 0, apart = 0;
    for (const Ray& ray : rays(2.0)) {
        const auto in_a = crossings(a, a.values, ray), in_b = crossings(b, b.values, ray);
        if (in_a.size() != in_b.size()) {
            ++apart;
            continue;
        }
        for (std::size_t i = 0; i < in_a.size(); ++i) {
            ++found;
            EXPECT_NEAR(in_a[i].distance, in_b[i].distance, tolerance);
            EXPECT_EQ(in_a[i].inside, in_b[i].inside);
            EXPECT_NEAR(glm::distance(in_a[i].normal, in_b[i].normal), 0.0, 1e-5);
        }
    }
    EXPECT_LE(apart, 1);
    EXPECT_GT(found, 40);
    return found;
}

TEST(ShapeTracer, aJuliaSetOfNoConstantIsASphere) {
    Shape julia = shape_of(ShapeKind::Julia), sphere = shape_of(ShapeKind::Sphere);
    std::fill_n(julia.values.begin(), 4, 0.0f);
    sphere.values = {1.0f};
    expect_same(julia, sphere, 1e-9);
}

TEST(ShapeTracer, aCutJuliaSetIsAHalfBall) {
    Shape julia = shape_of(ShapeKind::Julia), half = shape_of(ShapeKind::Csg);
    std::fill_n(julia.values.begin(), 4, 0.0f);
    julia.values[6] = 1.0f;  // above y = 0.25 there is nothing
    julia.values[8] = 0.25f;
    const mat4 below = glm::translate(mat4(1.0f), vec3(0, -1.75f, 0)) * glm::scale(mat4(1.0f), vec3(2.0f));
    half.solid.leaves = {{scene::CsgPrimitive::Sphere, mat4(1.0f), {}},
                         {scene::CsgPrimitive::Box, below, {}}};
    half.solid.program = {{std::nullopt, 0}, {std::nullopt, 1}, {scene::CsgOperation::Intersection, 0}};
    expect_same(julia, half, 1e-9);
}

TEST(ShapeTracer, aMandelbulbIsMetWhereItsOrbitsStay) {
    // Along y, z^power + c stays on the line: the 8th power and the point itself, three times.
    const Shape bulb = shape_of(ShapeKind::Mandelbulb);
    const auto hits = crossings(bulb, bulb.values, {.origin = {0, 3, 0}, .direction = {0, -2, 0}});
    ASSERT_FALSE(hits.empty());
    EXPECT_FALSE(hits.front().inside);
    const double y = 3.0 - 2.0 * hits.front().distance;
    double z = y;
    for (int i = 0; i < 6; ++i) z = std::pow(z, 8.0) + y;
    EXPECT_NEAR(z, std::pow(2.0, 1.0 / 7.0), 1e-5);
    EXPECT_NEAR(hits.front().normal.y, 1.0, 1e-5);
}

TEST(ShapeTracer, aSharpBlendIsASolid) {
    Shape blend = shape_of(ShapeKind::Blend), solid = shape_of(ShapeKind::Csg);
    blend.values = {0.0f};
    blend.blend_parts.resize(2);
    blend.blend_parts[0].primitive = scene::BlendPrimitive::Box;
    blend.blend_parts[0].size = vec3(0.7f);
    blend.blend_parts[0].color = {1, 0, 0};
    blend.blend_parts[1].size.x = 0.9f;
    blend.blend_parts[1].operation = scene::BlendOperation::Subtract;
    blend.blend_parts[1].color = {0, 1, 0};
    solid.solid.leaves = {{scene::CsgPrimitive::Box, glm::scale(mat4(1.0f), vec3(0.7f)), {}},
                          {scene::CsgPrimitive::Sphere, glm::scale(mat4(1.0f), vec3(0.9f)), {}}};
    solid.solid.program = {{std::nullopt, 0}, {std::nullopt, 1}, {scene::CsgOperation::Difference, 0}};
    expect_same(blend, solid, 1e-6);
    const Ray ray{.origin = {0.65, 0.65, 3}, .direction = {0, 0, -1}};
    const auto hits = crossings(blend, blend.values, ray);
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_EQ(hits[0].tint, vec3(1, 0, 0));
}

/// 2 x 2 x 2 voxels of half a metre, of which one is missing.
Shape corner_of_voxels(bool show_faces) {
    scene::Voxels voxels;
    voxels.voxel_size = 0.5f;
    voxels.origin = vec3(-0.5f);
    voxels.show_faces = show_faces;
    std::vector<scene::VoxelSample> samples;
    for (std::uint32_t i = 0; i < 7; ++i) samples.push_back({i, 1.0f, vec3(0.0f, 1.0f, 0.0f), vec3(0, 0, 1)});
    EXPECT_TRUE(build_tree(samples, voxels));
    Shape shape = shape_of(ShapeKind::Voxels);
    shape.voxels = std::make_shared<scene::Voxels>(voxels);
    return shape;
}

TEST(ShapeTracer, voxelsAreTheirCubes) {
    const Shape shape = corner_of_voxels(true);
    const auto first = [&](const Ray& ray) { return crossings(shape, {}, ray); };
    const auto front = first({.origin = {-0.2, -0.2, 2}, .direction = {0, 0, -1}});
    ASSERT_EQ(front.size(), 1u);
    EXPECT_NEAR(front[0].distance, 1.5, 1e-9);
    EXPECT_EQ(front[0].normal, dvec3(0, 0, 1));
    EXPECT_NEAR(front[0].tint.g, 1.0f, 0.01f);
    EXPECT_NEAR(front[0].tint.r, 0.0f, 0.01f);
    // Where one is missing, the one behind it; and not the one that the ray starts in.
    EXPECT_NEAR(first({.origin = {0.2, 0.2, 2}, .direction = {0, 0, -1}}).at(0).distance, 2.0, 1e-9);
    EXPECT_NEAR(first({.origin = {-0.2, 0.3, 0.2}, .direction = {0, 0, -1}}).at(0).distance, 0.2, 1e-9);
    EXPECT_TRUE(first({.origin = {0.2, 0.2, 2}, .direction = {0, 0, 1}}).empty());
    EXPECT_TRUE(first({.origin = {0.2, 0.2, 2}, .direction = {0, 0, -1}, .farthest = 1.9}).empty());
}

TEST(ShapeTracer, smoothVoxelsHaveTheirOwnNormal) {
    const Shape shape = corner_of_voxels(false);
    const auto hits = crossings(shape, {}, {.origin = {-2, -0.2, -0.2}, .direction = {1, 0, 0}});
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_NEAR(hits[0].normal.z, 1.0, 1e-4);
    EXPECT_FALSE(hits[0].inside);
    EXPECT_TRUE(crossings(shape, {}, {.origin = {-0.2, -0.2, -2}, .direction = {0, 0, 1}}).at(0).inside);
}

TEST(ShapeTracer, usersShapesAreRefused) {
    Shape shape;
    shape.kind = ShapeKind::User;
    shape.name = "twisted";
    fakes::expect_fault([&] { crossings(shape, {}, {}); }, ExitCode::Internal, "cannot run a user's GLSL");
    fakes::expect_fault([&] { crossings(shape, {}, {}); }, ExitCode::Internal, "twisted");
}

}  // namespace
}  // namespace foveray::reference
