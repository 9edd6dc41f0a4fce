#include "render/reference/tracer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "render/reference/surface.h"
#include "render/scene/scene_builder.h"

namespace foveray::reference {
namespace {

using scene::Node;
using scene::SceneBuilder;

void expect_near(dvec3 a, dvec3 b, double tolerance = 1e-6) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

scene::NodeId place(SceneBuilder& builder, scene::Mesh mesh, const scene::Transform& transform,
                    scene::MaterialId material = 0) {
    mesh.primitives[0].material = material;
    Node node;
    node.mesh = builder.add(std::move(mesh));
    node.local = transform;
    return builder.add(node);
}

/// A scene at its start, with everything that a Tracer needs.
struct Still {
    scene::Scene scene;
    Tracer tracer;

    explicit Still(SceneBuilder builder, Tracer::What what = Tracer::What::Instances)
        : scene(std::move(builder).build()), tracer(make(what)) {}
    Tracer make(Tracer::What what) const {
        scene::SceneAnimator animator(scene);
        return Tracer(scene, animator.advance(0), what);
    }
};

TEST(Tracer, planeAtAClosedFormDistance) {
    SceneBuilder builder;
    scene::Transform tilted;
    tilted.rotation = glm::angleAxis(pi / 6, vec3(0, 0, 1));
    tilted.translation = {0, -1, 0};
    place(builder, scene::make_rectangle(vec2(100)), tilted);
    const Still still(std::move(builder));
    const dvec3 normal(-0.5, std::sqrt(0.75), 0);
    for (const dvec3 direction : {dvec3(0, -1, 0), dvec3(0.3, -1, 0.2), dvec3(-0.2, -0.5, -1)}) {
        const auto hit = still.tracer.closest({.origin = {0, 2, 0}, .direction = direction});
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distance, glm::dot(dvec3(0, -3, 0), normal) / glm::dot(direction, normal), 1e-5);
        expect_near(hit->position, dvec3(0, 2, 0) + hit->distance * direction, 1e-9);
        expect_near(hit->geometric_normal, normal);
        expect_near(hit->shading_normal, normal);
        EXPECT_TRUE(hit->front);
    }
    EXPECT_FALSE(still.tracer.closest({.origin = {0, 2, 0}, .direction = {0, 1, 0}}));
}

TEST(Tracer, sphereAgainstTheQuadratic) {
    SceneBuilder builder;
    scene::Transform t;
    t.translation = {0.5f, 0, -4};
    t.scale = vec3(0.5f);
    place(builder, scene::make_sphere(2.0f, 96), t);  // radius 1 in the world
    const Still still(std::move(builder));
    int hits = 0;
    for (int i = -10; i <= 10; ++i) {
        for (int j = -10; j <= 10; ++j) {
            const dvec3 d = glm::normalize(dvec3(0.04 * i, 0.04 * j, -1)), to_center(0.5, 0, -4);
            const double along = glm::dot(d, to_center);
            const double discriminant = along * along - glm::dot(to_center, to_center) + 1.0;
            const auto hit = still.tracer.closest({.direction = d});
            if (std::abs(discriminant) < 0.05) continue;  // the mesh's outline is a polygon
            ASSERT_EQ(hit.has_value(), discriminant > 0.0);
            if (!hit) continue;
            ++hits;
            EXPECT_NEAR(hit->distance, along - std::sqrt(discriminant), 5e-3);
            expect_near(hit->shading_normal, glm::normalize(hit->position - to_center), 5e-3);
        }
    }
    EXPECT_GT(hits, 50);
}

TEST(Tracer, theNearestOfSeveralInstances) {
    SceneBuilder builder;
    for (const float z : {-5.0f, -2.0f, -9.0f}) {
        scene::Transform t;
        t.translation = {0, 0, z};
        place(builder, scene::make_box(vec3(0.5f)), t);
    }
    const Still still(std::move(builder));
    const auto hit = still.tracer.closest({.direction = {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 1.5, 1e-6);
    EXPECT_EQ(hit->object, 1u);
    expect_near(hit->geometric_normal, {0, 0, 1});
    EXPECT_NEAR(hit->uv0.x, 0.5f, 1e-5f);
}

TEST(Tracer, mirroredInstancesKeepTheirFront) {
    SceneBuilder builder;
    scene::Transform t;
    t.scale = {-1, 1, 1};
    t.translation = {0, 0, -3};
    place(builder, scene::make_box(vec3(0.5f)), t);
    const Still still(std::move(builder));
    const auto hit = still.tracer.closest({.direction = {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_TRUE(hit->front);
    expect_near(hit->geometric_normal, {0, 0, 1});
    expect_near(hit->shading_normal, {0, 0, 1});
}

TEST(Tracer, backsOfSingleSidedMaterialsCanBePassed) {
    SceneBuilder builder;
    scene::Material both;
    both.double_sided = true;
    const scene::MaterialId id = builder.add(both);
    scene::Transform low;
    low.translation = {0, -2, 0};
    place(builder, scene::make_rectangle(vec2(1)), {});
    place(builder, scene::make_rectangle(vec2(1)), low, id);
    const Still still(std::move(builder));
    const Ray from_below{.origin = {0, -1, 0}, .direction = {0, 1, 0}};
    ASSERT_TRUE(still.tracer.closest(from_below));
    EXPECT_FALSE(still.tracer.closest(from_below)->front);
    EXPECT_FALSE(still.tracer.closest(from_below, Side::FrontOnly));
    const Ray from_far_below{.origin = {0, -3, 0}, .direction = {0, 1, 0}};
    EXPECT_EQ(still.tracer.closest(from_far_below, Side::FrontOnly)->object, 1u);
}

/// A square at z = -2 with a picture of two halves: alpha 1 on the left, alpha `right` on the right.
Still two_halves(scene::AlphaMode mode, std::uint8_t right) {
    SceneBuilder builder;
    scene::TextureImage image{"halves", Image(2, 1, 4)};
    image.pixels.pixels = {255, 255, 255, 255, 255, 255, 255, right};
    scene::Texture texture;
    texture.image = builder.add(image);
    texture.sampler.mag = scene::Filter::Nearest;
    scene::Material material;
    material.alpha_mode = mode;
    material.base_color_texture.texture = builder.add(texture);
    const scene::MaterialId id = builder.add(material);
    scene::Transform upright;
    upright.rotation = glm::angleAxis(pi / 2, vec3(1, 0, 0));
    upright.translation = {0, 0, -2};
    place(builder, scene::make_rectangle(vec2(1)), upright, id);
    return Still(std::move(builder));
}

TEST(Tracer, alphaMask) {
    const Still still = two_halves(scene::AlphaMode::Mask, 127);
    const Ray left{.origin = {-0.5, 0, 0}}, right{.origin = {0.5, 0, 0}};
    EXPECT_TRUE(still.tracer.closest(left));
    EXPECT_FALSE(still.tracer.closest(right));
    EXPECT_EQ(still.tracer.transmittance(left), 0.0);
    EXPECT_EQ(still.tracer.transmittance(right), 1.0);
}

TEST(Tracer, alphaBlend) {
    const Still still = two_halves(scene::AlphaMode::Blend, 51);
    EXPECT_NEAR(still.tracer.transmittance({.origin = {0.5, 0, 0}}), 0.8, 1e-6);
    const auto hit = still.tracer.closest({.origin = {0.5, 0, 0}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->base_color.a, 0.2f, 1e-6f);
    EXPECT_FALSE(two_halves(scene::AlphaMode::Blend, 0).tracer.closest({.origin = {0.5, 0, 0}}));
}

TEST(Tracer, opaqueIgnoresAlpha) {
    const Still still = two_halves(scene::AlphaMode::Opaque, 0);
    EXPECT_EQ(still.tracer.transmittance({.origin = {0.5, 0, 0}}), 0.0);
}

TEST(Tracer, realSurfacesStandInStageSpace) {
    SceneBuilder builder;
    scene::RealSurface floor;
    floor.mesh = builder.add(scene::make_rectangle(vec2(1)));
    builder.add(floor);
    Pose world_from_stage;
    world_from_stage.position = {10, 2, 0};
    builder.set_world_from_stage(world_from_stage);
    const Still still(std::move(builder), Tracer::What::RealSurfaces);
    const auto hit = still.tracer.closest({.origin = {10.5, 5, 0}, .direction = {0, -1, 0}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 3.0, 1e-6);
}

TEST(Tracer, skinnedVerticesAreWhereTheirJointsPutThem) {
    SceneBuilder builder;
    scene::Mesh mesh = scene::make_box(vec3(0.5f));
    scene::Primitive& p = mesh.primitives[0];
    p.joints.assign(p.positions.size(), {0, 0, 0, 0});
    p.weights.assign(p.positions.size(), {1, 0, 0, 0});
    Node joint;
    joint.local.translation = {0, 0, -7};
    scene::Skin skin;
    skin.joints = {builder.add(joint)};
    skin.inverse_bind = {mat4(1)};
    const scene::NodeId body = place(builder, mesh, {});
    builder.set_skin(body, builder.add(skin));
    const Still still(std::move(builder));
    EXPECT_NEAR(still.tracer.closest({.direction = {0, 0, -1}})->distance, 6.5, 1e-6);
}

TEST(SampleTexture, filtersInLinearLightAndWraps) {
    SceneBuilder builder;
    scene::TextureImage image{"black and white", Image(2, 1, 4)};
    image.pixels.pixels = {0, 0, 0, 255, 255, 255, 255, 255};
    scene::Texture texture;
    texture.image = builder.add(image);
    texture.sampler.wrap_u = scene::Wrap::ClampToEdge;
    const scene::TextureId clamp = builder.add(texture);
    texture.sampler.wrap_u = scene::Wrap::Repeat;
    const scene::TextureId repeat = builder.add(texture);
    texture.sampler.wrap_u = scene::Wrap::MirroredRepeat;
    const scene::TextureId mirror = builder.add(texture);
    const scene::Scene& s = builder.so_far();
    EXPECT_FLOAT_EQ(sample_texture(s, clamp, {0.25f, 0.5f}, true).r, 0.0f);
    EXPECT_FLOAT_EQ(sample_texture(s, clamp, {0.5f, 0.5f}, true).r, 0.5f);
    EXPECT_FLOAT_EQ(sample_texture(s, clamp, {1.5f, 0.5f}, true).r, 1.0f);
    EXPECT_FLOAT_EQ(sample_texture(s, repeat, {1.25f, 0.5f}, true).r, 0.0f);
    EXPECT_FLOAT_EQ(sample_texture(s, repeat, {1.0f, 0.5f}, true).r, 0.5f);
    EXPECT_FLOAT_EQ(sample_texture(s, mirror, {1.25f, 0.5f}, true).r, 1.0f);
    EXPECT_FLOAT_EQ(sample_texture(s, mirror, {-0.25f, 0.5f}, true).r, 0.0f);
}

}  // namespace
}  // namespace foveray::reference
