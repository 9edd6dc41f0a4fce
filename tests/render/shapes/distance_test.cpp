// Julia sets, Mandelbulbs and blends: rays against a slow march through the sets themselves.
#include <cmath>

#include "render/reference/march.h"
#include "render/scene/scene_builder.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/fakes/random.h"
#include "tests/render/shapes/ray_rig.h"

namespace foveray::render {
namespace {

using scene::ShapeKind;

constexpr float apart = 30.0f;      // metres between the shapes, along x
constexpr float threshold = 0.25f;  // of a cone's width, at which a surface counts as hit

std::vector<scene::BlendPart> parts() {
    std::vector<scene::BlendPart> result(5);
    result[0].primitive = scene::BlendPrimitive::Box;
    result[0].size = {0.5f, 0.3f, 0.4f};
    result[1].size.x = 0.35f;
    result[1].object_from_part.translation = {0.4f, 0.3f, 0.2f};
    result[1].object_from_part.scale = {1.4f, 0.8f, 1.0f};
    result[2].primitive = scene::BlendPrimitive::Torus;
    result[2].size = {0.5f, 0.12f, 0.0f};
    result[2].object_from_part.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 0)));
    result[2].object_from_part.scale = vec3(1.5f);
    result[3].primitive = scene::BlendPrimitive::Capsule;
    result[3].size = {0.15f, 0.8f, 0.0f};
    result[3].operation = scene::BlendOperation::Subtract;
    result[4].size.x = 0.8f;
    result[4].object_from_part.scale = {1.0f, 0.7f, 1.2f};
    result[4].operation = scene::BlendOperation::Intersect;
    return result;
}

struct Example {
    const char* name;
    ShapeKind kind;
    std::vector<float> values;
    bool estimated;  // the distance is, so that hits come earlier
};

const std::vector<Example>& examples() {
    static const std::vector<Example> list = {
        {"julia", ShapeKind::Julia, {-0.2f, 0.6f, 0.2f, 0.2f, 10, 0, 0, 0, 0, 1, 1, 1}, true},
        {"julia far", ShapeKind::Julia, {-1.0f, 0.2f, 0.0f, 0.0f, 9, 0, 0, 0, 0, 1, 1, 1}, true},
        {"julia cut", ShapeKind::Julia, {-0.2f, 0.6f, 0.2f, 0.2f, 10, 0, 0.3f, 0.9f, 0.1f, 1, 1, 1}, true},
        {"mandelbulb 8", ShapeKind::Mandelbulb, {8, 4, 1, 1, 1}, true},
        {"mandelbulb 3", ShapeKind::Mandelbulb, {3, 5, 1, 1, 1}, true},
        {"blend", ShapeKind::Blend, {0.1f}, false},
        {"blend sharp", ShapeKind::Blend, {0.0f}, false},
    };
    return list;
}

reference::Field field_of(const Example& example) {
    if (example.kind == ShapeKind::Julia) return reference::field_of(scene::Julia(example.values));
    if (example.kind == ShapeKind::Mandelbulb) return reference::field_of(scene::Mandelbulb(example.values));
    return reference::field_of(parts(), example.values[0]);
}

reference::IsInside inside_of(const Example& example) { return reference::inside_of(field_of(example)); }

/// Each example once, turned and unevenly scaled, in a row along x.
scene::Scene row_of_examples() {
    fakes::Random random(11);
    scene::SceneBuilder builder;
    scene::Material material;
    material.base_color = {1, 1, 1, 1};
    material.double_sided = true;
    const scene::MaterialId id = builder.add(material);
    for (std::size_t i = 0; i < examples().size(); ++i) {
        scene::Shape shape;
        shape.kind = examples()[i].kind;
        shape.values = examples()[i].values;
        shape.material = id;
        if (shape.kind == ShapeKind::Blend) shape.blend_parts = parts();
        scene::Node node;
        node.local.translation = {apart * static_cast<float>(i), 0, 0};
        node.local.rotation = random.rotation();
        node.local.scale = random.vector(0.5f, 1.6f);
        node.shape = builder.add(std::move(shape));
        builder.add(std::move(node));
    }
    return std::move(builder).build();
}

/// Rays towards the example's middle from about 5 m away, or from within its bounds.
std::vector<shared::TestRay> rays_to(std::size_t example, std::size_t count, float spread, bool within) {
    fakes::Random random(static_cast<std::uint32_t>(100 + example));
    const vec3 center(apart * static_cast<float>(example), 0, 0);
    std::vector<shared::TestRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        shared::TestRay ray{};
        ray.origin = within ? center + random.vector(-0.3f, 0.3f) : center + 5.0f * random.direction();
        ray.direction =
            within ? random.direction() : glm::normalize(center + random.vector(-0.8f, 0.8f) - ray.origin);
        ray.t_max = ray.shadow_t_max = 12.0f;
        ray.cone = {0.0f, spread};
        rays.push_back(ray);
    }
    return rays;
}

/// The ray in a shape's object space; distances along it stay what they are.
reference::Ray in_object(const shared::TestRay& ray, const mat4& world_from_object) {
    const glm::dmat4 object_from_world = glm::inverse(glm::dmat4(world_from_object));
    reference::Ray result;
    result.origin = dvec3(object_from_world * glm::dvec4(dvec3(ray.origin), 1.0));
    result.direction = dvec3(object_from_world * glm::dvec4(dvec3(ray.direction), 0.0));
    result.farthest = double{ray.t_max};
    return result;
}

double least_object_length(const mat4& world_from_object) {
    const glm::dmat3 m = glm::inverse(glm::dmat3(glm::dmat4(world_from_object)));
    double least = 1e30;
    for (int row = 0; row < 3; ++row) {
        least = std::min(least, glm::length(dvec3(m[0][row], m[1][row], m[2][row])));
    }
    return least;
}

class DistanceShapes : public fakes::GpuTest {
  protected:
    static void SetUpTestSuite() {
        scene_ = new scene::Scene(row_of_examples());
        rig_ = new RayRig(device(), *scene_);
    }
    static void TearDownTestSuite() {
        delete rig_;
        delete scene_;
    }

    static inline scene::Scene* scene_ = nullptr;
    static inline RayRig* rig_ = nullptr;
};

TEST_F(DistanceShapes, RaysFromOutsideStopAtTheSet) {
    for (const float spread : {5e-4f, 2e-2f}) {
        for (std::size_t e = 0; e < examples().size(); ++e) {
            SCOPED_TRACE(std::string(examples()[e].name) + " spread " + std::to_string(spread));
            const std::vector<shared::TestRay> rays = rays_to(e, 150, spread, false);
            const auto answers = rig_->answers(0, rays);
            const mat4 world_from_object = rig_->changes().shape_instances[e].world_from_object;
            const double object_length = least_object_length(world_from_object);
            const reference::IsInside inside = inside_of(examples()[e]);
            int hits = 0, beyond = 0, off = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                reference::Ray ray = in_object(rays[i], world_from_object);
                ray.nearest = 2.0, ray.farthest = 8.0;  // the shape is within 3 m of its middle
                const double rate = glm::length(ray.direction);
                const shared::Surface& s = answers[i].surface;
                const auto truth = reference::first_side_change(ray, inside, 2e-3 / rate);
                const bool hit = s.kind == shared::SURFACE_VIRTUAL;
                EXPECT_EQ(hit, answers[i].transmittance == vec3(0.0f)) << i;
                // What is thicker than the cone must not be passed.
                const auto is_thick = [&] {
                    const double behind = truth->distance + double{spread} * truth->distance;
                    return inside(ray.origin + behind * ray.direction);
                };
                if (truth && (!hit || s.distance > truth->distance + 1e-4) && is_thick()) ++beyond;
                if (!hit) continue;
                ++hits;
                EXPECT_EQ(s.instance, e);
                EXPECT_EQ(s.flags & shared::SURFACE_FLAG_BACK_FACE, 0u);
                EXPECT_TRUE(std::isfinite(s.normal.x + s.normal.y + s.normal.z + s.position.x));
                EXPECT_NEAR(glm::length(s.normal), 1.0f, 1e-4f);
                const double width = double{spread} * double{s.distance};
                const double near =
                    1.02 * threshold * width * object_length + 2e-4;  // and 120 m from the origin

                const dvec3 p = ray.origin + double{s.distance} * ray.direction;
                if (examples()[e].kind == ShapeKind::Blend) {
                    EXPECT_LE(field_of(examples()[e])(p), near);
                } else if (!reference::has_both_sides(inside, p, 8.0 * near, 4000)) {
                    ++off;
                }
            }
            EXPECT_GT(hits, 40);
            EXPECT_LE(beyond, examples()[e].kind == ShapeKind::Mandelbulb ? 2 : 0);
            EXPECT_LE(off, hits / 20);
        }
    }
}

TEST_F(DistanceShapes, RaysFromInsideStopWhereTheyLeave) {
    for (std::size_t e = 0; e < examples().size(); ++e) {
        SCOPED_TRACE(examples()[e].name);
        const std::vector<shared::TestRay> rays = rays_to(e, 300, 5e-4f, true);
        const auto answers = rig_->answers(0, rays);
        const mat4 world_from_object = rig_->changes().shape_instances[e].world_from_object;
        const reference::IsInside inside = inside_of(examples()[e]);
        int from_inside = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const reference::Ray ray = in_object(rays[i], world_from_object);
            const shared::Surface& s = answers[i].surface;
            if (!inside(ray.origin)) continue;
            ++from_inside;
            EXPECT_EQ(s.kind, shared::SURFACE_VIRTUAL);
            EXPECT_EQ(answers[i].transmittance, vec3(0.0f));
            if (examples()[e].kind != ShapeKind::Blend) continue;
            EXPECT_NE(s.flags & shared::SURFACE_FLAG_BACK_FACE, 0u);
            const dvec3 p = ray.origin + double{s.distance} * ray.direction;
            EXPECT_NEAR(field_of(examples()[e])(p), 0.0, 1e-3);
            const auto truth = reference::first_side_change(ray, inside, 1e-3);
            ASSERT_TRUE(truth.has_value());
            EXPECT_LE(s.distance, truth->distance + 1e-4);
        }
        EXPECT_GT(from_inside, 10);
    }
}

TEST_F(DistanceShapes, RaysFromTheSurfaceHitOnlyWhatTheyGoInto) {
    for (std::size_t e = 0; e < examples().size(); ++e) {
        if (examples()[e].kind != ShapeKind::Blend) continue;
        SCOPED_TRACE(examples()[e].name);
        const std::vector<shared::TestRay> rays = rays_to(e, 300, 4e-3f, false);
        std::vector<shared::TestRay> away, into;
        std::vector<float> thresholds;
        fakes::Random random(5);
        for (const shared::RayAnswer& answer : rig_->answers(0, rays)) {
            const shared::Surface& s = answer.surface;
            if (s.kind != shared::SURFACE_VIRTUAL) continue;
            shared::TestRay ray{};
            ray.origin = s.position;
            ray.direction = glm::normalize(s.geometric_normal + 0.9f * random.direction());
            ray.t_max = ray.shadow_t_max = 3.0f * s.footprint;
            ray.cone = {s.footprint, 4e-3f};
            away.push_back(ray);
            ray.direction = -ray.direction;
            into.push_back(ray);
        }
        ASSERT_GT(away.size(), 100u);
        int hit_again = 0, passed = 0;
        for (const shared::RayAnswer& a : rig_->answers(0, away)) {
            hit_again += a.surface.kind != shared::SURFACE_NONE || a.transmittance != vec3(1.0f);
        }
        for (const shared::RayAnswer& a : rig_->answers(0, into)) {
            passed += a.surface.kind == shared::SURFACE_NONE || a.transmittance != vec3(0.0f);
        }
        EXPECT_LE(hit_again, 2);  // in the grooves, where another wall is as near
        EXPECT_EQ(passed, 0);
    }
}

/// Position error is enough for a secondary ray not to start within the threshold.
TEST_F(DistanceShapes, LightLeavesTheSurface) {
    for (std::size_t e = 0; e < examples().size(); ++e) {
        SCOPED_TRACE(examples()[e].name);
        std::vector<shared::TestRay> rays;
        for (const shared::RayAnswer& answer : rig_->answers(0, rays_to(e, 300, 2e-3f, false))) {
            const shared::Surface& s = answer.surface;
            if (s.kind != shared::SURFACE_VIRTUAL) continue;
            shared::TestRay ray{};
            ray.origin = s.position + s.position_error * s.geometric_normal;
            ray.direction = s.geometric_normal;
            ray.t_max = ray.shadow_t_max = 2.0f * s.footprint;
            ray.cone = {s.footprint, 2e-3f};
            rays.push_back(ray);
        }
        int blocked = 0;
        for (const shared::RayAnswer& a : rig_->answers(0, rays)) blocked += a.transmittance != vec3(1.0f);
        EXPECT_LE(blocked, static_cast<int>(rays.size()) / 20);  // fractals are rough
    }
}

TEST_F(DistanceShapes, FollowTheirAnimatedParameters) {
    scene::SceneBuilder builder;
    scene::Shape shape;
    shape.kind = ShapeKind::Julia;
    shape.values = examples()[0].values;
    scene::Node node;
    node.shape = builder.add(std::move(shape));
    scene::Animation animation;
    scene::AnimationChannel channel;
    channel.node = builder.add(std::move(node));
    channel.property = scene::AnimatedProperty::ShapeValues;
    channel.width = 4;
    channel.times = {0.0f, 1.0f};
    channel.values = {-0.2f, 0.6f, 0.2f, 0.2f, -1.0f, 0.2f, 0.0f, 0.0f};
    animation.channels.push_back(std::move(channel));
    builder.add(std::move(animation));
    const scene::Scene scene = std::move(builder).build();
    RayRig rig(device(), scene);
    const std::vector<shared::TestRay> rays = rays_to(0, 200, 1e-3f, false);
    std::vector<float> sizes;
    for (const double seconds : {0.0, 0.5}) {
        const auto answers = rig.answers(from_seconds(seconds), rays);
        const scene::ShapeState& now = rig.changes().shapes[0];
        sizes.push_back(now.bounds.max.x);
        const scene::Julia julia(now.values);
        EXPECT_FLOAT_EQ(now.bounds.max.x, julia.radius());
        const reference::IsInside inside = reference::inside_of(reference::field_of(julia));
        int off = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const reference::Ray ray = in_object(rays[i], mat4(1.0f));
            const bool hit = answers[i].surface.kind == shared::SURFACE_VIRTUAL;
            const dvec3 p = ray.origin + double{answers[i].surface.distance} * ray.direction;
            if (hit) off += !reference::has_both_sides(inside, p, 1e-2, 2000);
        }
        EXPECT_LE(off, 8);
    }
    EXPECT_GT(sizes[1], sizes[0] + 0.01f);
}

TEST_F(DistanceShapes, WideConesTakeFewerSteps) {
    scene::SceneBuilder builder;
    scene::Shape shape;
    shape.kind = ShapeKind::Mandelbulb;
    shape.values = {8, 8, 1, 1, 1};
    scene::Node node;
    node.shape = builder.add(std::move(shape));
    builder.add(std::move(node));
    const scene::Scene scene = std::move(builder).build();
    RayRig rig(device(), scene);
    const auto mean_steps = [&](float spread) {
        double sum = 0.0;
        const std::vector<shared::TestRay> rays = rays_to(0, 400, spread, false);
        for (const std::uint32_t steps : rig.steps(rays)) {
            EXPECT_LE(steps, 256u);
            sum += steps;
        }
        return sum / static_cast<double>(rays.size());
    };
    const double finest = mean_steps(0.0f), pixel = mean_steps(1e-3f), outskirts = mean_steps(2e-2f);
    EXPECT_GT(finest, 10.0);
    EXPECT_LT(pixel, 0.8 * finest);
    EXPECT_LT(outskirts, 0.6 * pixel);
}

}  // namespace
}  // namespace foveray::render
