// Sphere, boxes, plane and csg: rays against closed forms.
#include <cmath>

#include "render/reference/tracer.h"
#include "render/scene/scene_builder.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/fakes/random.h"
#include "tests/render/shapes/ray_rig.h"

namespace foveray::render {
namespace {

using scene::CsgOperation;
using scene::CsgPrimitive;
using scene::ShapeKind;

scene::Material two_sided() {
    scene::Material material;
    material.double_sided = true;
    return material;
}

/// A random tree over `leaf_count` leaves, in postfix order.
scene::CsgSolid random_solid(fakes::Random& random, std::uint32_t leaf_count,
                             const std::vector<scene::MaterialId>& materials) {
    scene::CsgSolid solid;
    std::uint32_t on_stack = 0;
    while (solid.leaves.size() < leaf_count || on_stack > 1) {
        const bool must_join = solid.leaves.size() == leaf_count;
        if (on_stack >= 2 && (must_join || random.below(2) == 0)) {
            // Mostly unions and differences: random intersections leave little.
            const std::uint32_t pick = random.below(7);
            solid.program.push_back({pick < 3   ? CsgOperation::Union
                                     : pick < 6 ? CsgOperation::Difference
                                                : CsgOperation::Intersection,
                                     0});
            --on_stack;
            continue;
        }
        scene::CsgLeaf leaf;
        leaf.primitive = static_cast<CsgPrimitive>(random.below(3));
        leaf.object_from_leaf = glm::translate(mat4(1.0f), random.vector(-0.3f, 0.3f)) *
                                glm::mat4_cast(random.rotation()) *
                                glm::scale(mat4(1.0f), random.vector(0.15f, 0.5f));
        if (random.below(4) != 0) leaf.material = materials[random.below(3)];
        solid.program.push_back({std::nullopt, static_cast<std::uint32_t>(solid.leaves.size())});
        solid.leaves.push_back(leaf);
        ++on_stack;
    }
    return solid;
}

std::vector<float> random_values(fakes::Random& random, ShapeKind kind) {
    switch (kind) {
        case ShapeKind::Sphere:
            return {random.in(0.2f, 0.7f)};
        case ShapeKind::Box: {
            const vec3 half = random.vector(0.1f, 0.7f);
            return {half.x, half.y, half.z};
        }
        case ShapeKind::OrientedBox: {
            const vec3 half = random.vector(0.1f, 0.7f);
            const quat q = 0.5f * random.rotation();  // of any length
            return {half.x, half.y, half.z, q.x, q.y, q.z, q.w};
        }
        case ShapeKind::Plane:
            return {random.in(0.3f, 0.9f), random.in(0.3f, 0.9f), 0.0f, 0.0f, 0.0f, 0.0f};
        default:
            return {};
    }
}

constexpr std::array analytic = {ShapeKind::Sphere, ShapeKind::Box, ShapeKind::OrientedBox, ShapeKind::Plane,
                                 ShapeKind::Csg};

/// Shapes of these kinds in a cube of 6 m round the origin, turned, unevenly scaled, sheared and mirrored,
/// with single-sided, double-sided and, where asked for, see-through materials; every fourth stands there
/// three times.
scene::Scene random_shapes(std::uint32_t seed, std::span<const ShapeKind> kinds, bool see_through) {
    fakes::Random random(seed);
    scene::SceneBuilder builder;
    std::vector<scene::MaterialId> materials;
    for (int i = 0; i < 6; ++i) {
        scene::Material material;
        material.base_color = {1, 1, 1, 1};
        material.double_sided = i % 2 == 0;
        if (see_through && i % 3 != 0) {
            material.base_color.a = 0.25f * static_cast<float>(1 + i % 3);
            material.alpha_mode = scene::AlphaMode::Blend;
        }
        materials.push_back(builder.add(material));
    }
    for (std::uint32_t i = 0; i < 20; ++i) {
        scene::Shape shape;
        shape.kind = kinds[i % kinds.size()];
        shape.material = materials[random.below(6)];
        shape.values = random_values(random, shape.kind);
        if (shape.kind == ShapeKind::Csg) shape.solid = random_solid(random, 2 + random.below(15), materials);
        scene::Node parent;
        parent.local.translation = random.vector(-3, 3);
        parent.local.rotation = random.rotation();
        parent.local.scale = random.vector(0.4f, 1.8f);
        scene::Node child;
        child.parent = builder.add(parent);
        child.local.rotation = random.rotation();
        child.local.scale = {i % 3 == 0 ? -1.0f : 1.0f, random.in(0.5f, 1.5f), i % 5 == 0 ? -1.0f : 1.0f};
        for (std::uint32_t k = 0; i % 4 == 0 && k < 3; ++k) {
            scene::Transform transform;
            transform.translation = random.vector(-1, 1);
            transform.scale = random.vector(0.6f, 1.4f);
            child.mesh_instances.push_back(transform);
        }
        child.shape = builder.add(std::move(shape));
        builder.add(child);
    }
    return std::move(builder).build();
}

/// From within the cube, where many start inside shapes, and from round it.
std::vector<shared::TestRay> random_rays(std::uint32_t seed, std::size_t count) {
    fakes::Random random(seed);
    std::vector<shared::TestRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        shared::TestRay ray{};
        ray.origin = random.vector(-3, 3);
        if (i % 2 == 0) ray.origin = 8.0f * glm::normalize(ray.origin);
        ray.direction = glm::normalize(random.vector(-2.5f, 2.5f) - ray.origin);
        ray.t_max = ray.shadow_t_max = 1000.0f;
        rays.push_back(ray);
    }
    return rays;
}

reference::Ray exact(const shared::TestRay& ray, double farthest) {
    return {.origin = ray.origin, .direction = ray.direction, .nearest = 0.0, .farthest = farthest};
}

/// Rays that graze an edge may find one thing or the other. Returns how many agree on what they meet.
int expect_agreement(const scene::Scene& scene, const RayRig& rig, const std::vector<shared::TestRay>& rays,
                     const std::vector<shared::RayAnswer>& answers) {
    const reference::Tracer tracer(scene, rig.changes());
    int same = 0, hits = 0, inside = 0, other_normal = 0, other_light = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const shared::Surface& s = answers[i].surface;
        const auto hit = tracer.closest(exact(rays[i], rays[i].t_max), reference::Side::FrontOnly);
        EXPECT_TRUE(std::isfinite(s.distance));
        const double light = tracer.transmittance(exact(rays[i], rays[i].shadow_t_max));
        other_light += std::abs(answers[i].transmittance.g - light) > 1e-3 * (light + 1e-3);
        if (hit.has_value() != (s.kind == shared::SURFACE_VIRTUAL)) continue;
        if (!hit) {
            ++same;
            continue;
        }
        const double tolerance = 1e-4 + 2e-5 * hit->distance;
        if (hit->object != s.instance || std::abs(hit->distance - double{s.distance}) > tolerance) continue;
        ++same, ++hits;
        inside += !hit->front;
        EXPECT_EQ((s.flags & shared::SURFACE_FLAG_BACK_FACE) != 0, !hit->front);
        EXPECT_LE(glm::length(dvec3(s.position) - hit->position), 4e-4);
        EXPECT_EQ(s.previous_position, s.previous_position);
        const vec3 normal = (hit->front ? 1.0f : -1.0f) * hit->geometric_normal;
        // Next to an edge either face will do.
        other_normal += glm::length(s.geometric_normal - normal) > 5e-3f || s.material != hit->material;
    }
    const auto few = static_cast<int>(rays.size() / 200);
    EXPECT_GE(same, static_cast<int>(rays.size()) - few);
    EXPECT_LE(other_normal, few);
    EXPECT_LE(other_light, few);
    EXPECT_GT(hits, static_cast<int>(rays.size() / 5));
    EXPECT_GT(inside, 25);
    return same;
}

using AnalyticShapeTest = fakes::GpuTest;

TEST_F(AnalyticShapeTest, agreeWithClosedForms) {
    const auto rays = random_rays(100, 20000);
    const scene::Scene scene = random_shapes(1, analytic, false);
    RayRig rig(device(), scene);
    expect_agreement(scene, rig, rays, rig.answers(0, rays));
}

TEST_F(AnalyticShapeTest, solidsAgreeWithIntervals) {
    const std::array only = {ShapeKind::Csg};
    const auto rays = random_rays(200, 20000);
    for (const std::uint32_t seed : {2u, 3u}) {
        const scene::Scene scene = random_shapes(seed, only, seed == 3u);
        RayRig rig(device(), scene);
        expect_agreement(scene, rig, rays, rig.answers(0, rays));
    }
}

TEST_F(AnalyticShapeTest, seeThroughShapesLetTheirPartOfTheLightThrough) {
    const auto rays = random_rays(300, 10000);
    const scene::Scene scene = random_shapes(4, analytic, true);
    RayRig rig(device(), scene);
    expect_agreement(scene, rig, rays, rig.answers(0, rays));
}

TEST_F(AnalyticShapeTest, whatASurfaceRayMeetsBlocksAShadowRay) {
    auto rays = random_rays(400, 4000);
    const scene::Scene scene = random_shapes(5, analytic, false);
    RayRig rig(device(), scene);
    const auto first = rig.answers(0, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const shared::Surface& s = first[i].surface;
        if (s.kind == shared::SURFACE_VIRTUAL) rays[i].shadow_t_max = 1.0001f * s.distance + 1e-4f;
    }
    const auto beyond = rig.answers(0, rays);
    int through = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool met = first[i].surface.kind == shared::SURFACE_VIRTUAL;
        // Single-sided shapes block light from inside too: light may be blocked where nothing is seen.
        through += met && beyond[i].transmittance != vec3(0.0f);
    }
    EXPECT_LE(through, 2) << "of rays that graze an edge";
}

TEST_F(AnalyticShapeTest, raysAlongFacesAndEdgesGiveNoNaN) {
    std::vector<shared::TestRay> rays;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0f, 1.0f}) {
            for (const float y : {-0.5f, 0.0f, 0.25f, 0.5f}) {
                for (const float z : {-0.5f, 0.0f, 0.25f, 0.5f}) {
                    for (const float start : {-2.0f, -0.5f, 0.0f, 0.5f, 2.0f}) {
                        shared::TestRay ray{};
                        ray.origin[axis] = start;
                        ray.origin[(axis + 1) % 3] = y;
                        ray.origin[(axis + 2) % 3] = z;
                        ray.direction[axis] = sign;
                        ray.t_max = ray.shadow_t_max = 100.0f;
                        rays.push_back(ray);
                    }
                }
            }
        }
    }
    for (const ShapeKind kind : analytic) {
        scene::SceneBuilder builder;
        scene::Shape shape;
        shape.kind = kind;
        shape.values = scene::default_values(scene::shape_kind(kind).parameters);
        if (kind == ShapeKind::Csg) {
            const mat4 half = glm::scale(mat4(1.0f), vec3(0.5f));
            shape.solid.leaves = {{CsgPrimitive::Box, half, {}}, {CsgPrimitive::Cylinder, half, {}}};
            shape.solid.program = {{std::nullopt, 0}, {std::nullopt, 1}, {CsgOperation::Union, 0}};
        }
        shape.material = builder.add(two_sided());
        scene::Node node;
        node.shape = builder.add(shape);
        builder.add(node);
        const scene::Scene scene = std::move(builder).build();
        RayRig rig(device(), scene);
        const auto answers = rig.answers(0, rays);
        const scene::Aabb bounds = bounds_of(scene.shapes[0], scene.shapes[0].values);
        int hits = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const shared::Surface& s = answers[i].surface;
            if (s.kind != shared::SURFACE_VIRTUAL) continue;
            ++hits;
            EXPECT_TRUE(std::isfinite(s.distance) && s.distance > 0.0f) << s.distance;
            EXPECT_NEAR(glm::length(s.normal), 1.0f, 1e-4f);
            EXPECT_NEAR(glm::length(s.geometric_normal), 1.0f, 1e-4f);
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(s.position, bounds.min - 1e-4f)));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(s.position, bounds.max + 1e-4f)));
        }
        EXPECT_GT(hits, 10);
    }
}

TEST_F(AnalyticShapeTest, facesThatLieInEachOtherLeaveNoSkin) {
    // A box less a box that shares five of its faces leaves a slab; seen from the open side it is 0.5 m deep.
    scene::SceneBuilder builder;
    scene::Shape shape;
    shape.kind = ShapeKind::Csg;
    shape.solid.leaves = {
        {CsgPrimitive::Box, glm::scale(mat4(1.0f), vec3(0.5f)), {}},
        {CsgPrimitive::Box,
         glm::translate(mat4(1.0f), vec3(0, 0, 0.25f)) * glm::scale(mat4(1.0f), vec3(0.5f, 0.5f, 0.25f)),
         {}}};
    shape.solid.program = {{std::nullopt, 0}, {std::nullopt, 1}, {CsgOperation::Difference, 0}};
    shape.material = builder.add(two_sided());
    scene::Node node;
    node.local.rotation = glm::normalize(quat(0.9f, 0.3f, -0.2f, 0.1f));
    node.local.translation = {0.3f, -0.7f, 1.1f};
    node.shape = builder.add(shape);
    builder.add(node);
    const scene::Scene scene = std::move(builder).build();
    RayRig rig(device(), scene);
    fakes::Random random(9);
    std::vector<shared::TestRay> rays;
    std::vector<float> expected;
    for (int i = 0; i < 2000; ++i) {
        const vec3 from(random.in(-0.45f, 0.45f), random.in(-0.45f, 0.45f), 2.0f),
            to(0.5f * from.x, 0.5f * from.y, 0.0f);
        shared::TestRay ray{};
        ray.origin = node.local.rotation * from + node.local.translation;
        ray.direction = node.local.rotation * glm::normalize(to - from);
        ray.t_max = ray.shadow_t_max = 100.0f;
        rays.push_back(ray);
        expected.push_back(glm::length(to - from));
    }
    const auto answers = rig.answers(0, rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
        EXPECT_NEAR(answers[i].surface.distance, expected[i], 1e-4f);
}

TEST_F(AnalyticShapeTest, previousPositionsFollowAnimatedNodes) {
    scene::SceneBuilder builder;
    scene::Node node;
    scene::Shape shape;
    shape.kind = ShapeKind::OrientedBox;
    shape.values = scene::default_values(scene::shape_kind(shape.kind).parameters);
    node.shape = builder.add(shape);
    scene::Animation animation;
    animation.channels.push_back({.node = builder.add(node),
                                  .property = scene::AnimatedProperty::Translation,
                                  .times = {0.0f, 1.0f},
                                  .values = {0, 0, 0, 1, 0, 0}});
    builder.add(animation);
    const scene::Scene scene = std::move(builder).build();
    RayRig rig(device(), scene);
    shared::TestRay ray{};
    ray.origin = {0.2f, 0.1f, 3.0f};
    ray.direction = {0, 0, -1};
    ray.t_max = ray.shadow_t_max = 100.0f;
    for (const float time : {0.0f, 0.25f, 0.5f}) {
        const shared::Surface s = rig.answers(from_seconds(time), {ray})[0].surface;
        ASSERT_EQ(s.kind, shared::SURFACE_VIRTUAL);
        EXPECT_NEAR(s.position.x - s.previous_position.x, time == 0.0f ? 0.0f : 0.25f, 1e-5f);
    }
}

/// Also a mesh. Vulkan forbids singular instances, which the validation layer does not see: their transform
/// is replaced.
TEST_F(AnalyticShapeTest, aScaleOfZeroHidesAtThatTime) {
    for (const bool is_mesh : {false, true}) {
        scene::SceneBuilder builder;
        scene::Node node;
        if (is_mesh) {
            node.mesh = builder.add(scene::make_box(vec3(0.5f)));
        } else {
            scene::Shape shape;
            shape.values = {0.5f};
            node.shape = builder.add(shape);
        }
        scene::Animation animation;
        animation.channels.push_back({.node = builder.add(node),
                                      .property = scene::AnimatedProperty::Scale,
                                      .times = {0.0f, 1.0f, 2.0f},
                                      .values = {1, 1, 1, 0, 1, 0, -1, 1, 1}});
        builder.add(animation);
        const scene::Scene scene = std::move(builder).build();
        RayRig rig(device(), scene);
        shared::TestRay ray{};
        ray.origin = {0.01f, 0.02f, 3.0f};
        ray.direction = {0, 0, -1};
        ray.t_max = ray.shadow_t_max = 100.0f;
        for (const float time : {0.0f, 1.0f, 1.5f}) {
            const shared::RayAnswer answer = rig.answers(from_seconds(time), {ray})[0];
            EXPECT_EQ(answer.surface.kind == shared::SURFACE_NONE, time == 1.0f);
            EXPECT_EQ(answer.transmittance, vec3(time == 1.0f ? 1.0f : 0.0f));
            for (const GpuInstance& instance : rig.instances()) {
                EXPECT_NE(glm::determinant(instance.world_from_object), 0.0f);
            }
        }
    }
}

TEST_F(AnalyticShapeTest, checkerFadesToItsMeanWithTheFootprint) {
    scene::SceneBuilder builder;
    scene::Shape shape;
    shape.kind = ShapeKind::Plane;
    shape.values = {50.0f, 50.0f, 0.5f, 0.2f, 0.0f, 0.4f};
    shape.material = builder.add(two_sided());
    scene::Node node;
    node.shape = builder.add(shape);
    builder.add(node);
    const scene::Scene scene = std::move(builder).build();
    RayRig rig(device(), scene);
    fakes::Random random(7);
    std::vector<shared::TestRay> fine, coarse;
    for (int i = 0; i < 500; ++i) {
        shared::TestRay ray{};
        ray.origin = {random.in(-5, 5), 2.0f, random.in(-5, 5)};
        ray.direction = glm::normalize(vec3(random.in(-1, 1), -1, random.in(-1, 1)));
        ray.t_max = ray.shadow_t_max = 100.0f;
        fine.push_back(ray);
        ray.cone = {.width = 20.0f, .spread = 0.0f};
        coarse.push_back(ray);
    }
    const reference::Tracer tracer(scene, (rig.answers(0, fine), rig.changes()));
    const auto sharp = rig.answers(0, fine), blurred = rig.answers(0, coarse);
    int other = 0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
        const auto hit = tracer.closest(exact(fine[i], 100.0));
        other += glm::length(sharp[i].surface.base_color - vec3(hit->base_color)) > 1e-2f;
        EXPECT_LE(glm::length(blurred[i].surface.base_color - vec3(0.6f, 0.5f, 0.7f)), 0.02f);
    }
    EXPECT_LE(other, 3);
}

}  // namespace
}  // namespace foveray::render
