// Julia sets, Mandelbulbs, blends and a user's shape: rays against a slow march through the sets themselves.
#include <cmath>

#include "render/reference/march.h"
#include "render/scene/scene_builder.h"
#include "render/user_shapes/compile.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/fakes/random.h"
#include "tests/render/shapes/ray_rig.h"

namespace foveray::render {
namespace {

using scene::ShapeKind;

constexpr float apart = 12.0f;              // metres between the shapes
constexpr float threshold = 0.25f;          // of a cone's width, at which a surface counts as hit
constexpr std::size_t transform_count = 4;  // of each example

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
        {"user's", ShapeKind::User, {0.6f, 0.3f, 0.4f, 0.1f}, false},
    };
    return list;
}

/// A rounded box with a bite taken out of it, as a user writes it.
constexpr const char* bitten_box = R"(
float distance_at(vec3 p, vec3 half_size, float rounding) {
    vec3 q = abs(p) - half_size;
    float box = length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0) - rounding;
    return max(box, 0.45 - distance(p, vec3(0.5, 0.4, 0.3)));
}
)";

reference::Field bitten_box_field(const std::vector<float>& values) {
    const dvec3 half_size(values[0], values[1], values[2]);
    const double rounding = values[3];
    return [=](const dvec3& p) {
        const dvec3 q = glm::abs(p) - half_size;
        const double box =
            glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0) - rounding;
        return std::max(box, 0.45 - glm::distance(p, dvec3(0.5, 0.4, 0.3)));
    };
}

reference::Field field_of(const Example& example) {
    if (example.kind == ShapeKind::Julia) return reference::field_of(scene::Julia(example.values));
    if (example.kind == ShapeKind::Mandelbulb) return reference::field_of(scene::Mandelbulb(example.values));
    if (example.kind == ShapeKind::User) return bitten_box_field(example.values);
    return reference::field_of(parts(), example.values[0]);
}

/// The middle of an example's `which`-th transform. Instances count the same way: transforms fastest.
vec3 middle_of(std::size_t example, std::size_t which) {
    return apart * vec3(static_cast<float>(example) - 3.5f, 0.0f, static_cast<float>(which) - 1.5f);
}

/// Each example in a row along x, each in several random transforms: turned and unevenly scaled, mirrored,
/// sheared, and both.
scene::Scene examples_in_transforms() {
    fakes::Random random(11);
    scene::SceneBuilder builder;
    scene::Material material;
    material.base_color = {1, 1, 1, 1};
    material.double_sided = true;
    const scene::MaterialId id = builder.add(material);
    const scene::UserShapeId user = builder.add(
        {scene::parse_user_shape("bitten_box.glsl", bitten_box), {{"half_size", 3}, {"rounding", 1}}});
    for (std::size_t e = 0; e < examples().size(); ++e) {
        scene::Shape shape;
        shape.kind = examples()[e].kind;
        shape.values = examples()[e].values;
        shape.material = id;
        if (shape.kind == ShapeKind::Blend) shape.blend_parts = parts();
        if (shape.kind == ShapeKind::User) {
            shape.user = user;
            shape.user_bounds = {vec3(-0.75f), vec3(0.75f)};
        }
        const scene::ShapeId shape_id = builder.add(std::move(shape));
        for (std::size_t k = 0; k < transform_count; ++k) {
            const bool mirrored = k % 2 == 1, sheared = k >= 2;
            scene::Node parent;
            parent.local.translation = middle_of(e, k);
            parent.local.rotation = random.rotation();
            if (sheared) parent.local.scale = random.vector(0.7f, 1.3f);
            scene::Node child;
            child.parent = builder.add(std::move(parent));
            child.local.rotation = random.rotation();
            child.local.scale = random.vector(0.6f, 1.4f);
            if (mirrored) child.local.scale[static_cast<int>(random.below(3))] *= -1.0f;
            child.shape = shape_id;
            builder.add(std::move(child));
        }
    }
    return std::move(builder).build();
}

/// Rays towards a middle from about 5 m away, or from near it.
std::vector<shared::TestRay> rays_to(const vec3& middle, std::uint32_t seed, std::size_t count, float spread,
                                     bool within) {
    fakes::Random random(seed);
    std::vector<shared::TestRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        shared::TestRay ray{};
        ray.origin = middle + (within ? random.vector(-0.3f, 0.3f) : 5.0f * random.direction());
        ray.direction =
            within ? random.direction() : glm::normalize(middle + random.vector(-0.8f, 0.8f) - ray.origin);
        ray.t_max = ray.shadow_t_max = 8.5f;  // ends before the next shape
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

/// The normal that a hit ought to have, by differences: gradients transform by the inverse transpose.
vec3 expected_normal(const Example& example, const dvec3& p, double near, const mat4& world_from_object) {
    reference::Field field = field_of(example);
    if (example.kind == ShapeKind::Julia) {
        // The surface is the set's or the cut's: their levels cannot be compared.
        scene::Julia julia(example.values);
        const vec3 cut = julia.cut_normal;
        const bool on_cut = std::abs(glm::dot(dvec3(cut), p) - double{julia.cut_offset}) < near;
        if (cut != vec3(0.0f) && on_cut) {
            field = [cut](const dvec3& q) { return glm::dot(dvec3(cut), q); };
        } else {
            julia.cut_normal = vec3(0.0f);
            field = reference::field_of(julia);
        }
    }
    const double width = example.estimated ? 1e-7 : near;
    dvec3 slope(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 step(0.0);
        step[axis] = width;
        slope[axis] = field(p + step) - field(p - step);
    }
    const glm::dmat3 linear(glm::dmat4{world_from_object});
    return vec3(glm::normalize(glm::transpose(glm::inverse(linear)) * slope));
}

/// A Mandelbulb's normals are differences of its estimate as wide as the threshold, over which the set is
/// rough: most are within 26 degrees. Those of the others are off only at edges narrower than the cone.
bool is_near(const Example& example, vec3 normal, vec3 expected) {
    return glm::dot(normal, expected) > (example.kind == ShapeKind::Mandelbulb ? 0.9f : 0.99f);
}

int allowed_normals(const Example& example, int hits) {
    return hits / (example.kind == ShapeKind::Mandelbulb ? 7 : 10);
}

class DistanceShapes : public fakes::GpuTest {
  protected:
    static void SetUpTestSuite() {
        scene_ = new scene::Scene(examples_in_transforms());
        rig_ = new RayRig(device(), *scene_, {user_shapes::compile(scene_->user_shapes[0])});
    }
    static void TearDownTestSuite() {
        delete rig_;
        delete scene_;
    }

    static inline scene::Scene* scene_ = nullptr;
    static inline RayRig* rig_ = nullptr;
};

/// How far the surface may be from a hit in object space: the sphere tracing's threshold, and rounding.
double nearness(const shared::TestRay& ray, float distance, double object_length) {
    return 1.02 * threshold * double{ray.cone.spread} * double{distance} * object_length + 2e-4;
}

TEST_F(DistanceShapes, RaysFromOutsideStopAtTheSet) {
    for (std::size_t e = 0; e < examples().size(); ++e) {
        const bool exact = !examples()[e].estimated;
        const reference::Field field = field_of(examples()[e]);
        const reference::IsInside inside = reference::inside_of(field);
        for (const float spread : {5e-4f, 2e-2f}) {
            int hits = 0, beyond = 0, off = 0, other_normal = 0;
            for (std::size_t k = 0; k < transform_count; ++k) {
                const std::size_t instance = e * transform_count + k;
                SCOPED_TRACE(std::string(examples()[e].name) + " transform " + std::to_string(k) +
                             " spread " + std::to_string(spread));
                const auto rays =
                    rays_to(middle_of(e, k), static_cast<std::uint32_t>(100 + instance), 80, spread, false);
                const auto answers = rig_->answers(0, rays);
                const mat4 world_from_object = rig_->changes().shape_instances[instance].world_from_object;
                EXPECT_EQ(glm::determinant(world_from_object) < 0.0f, k % 2 == 1);
                const double object_length = least_object_length(world_from_object);
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
                    EXPECT_EQ(s.instance, instance);
                    EXPECT_EQ(s.flags & shared::SURFACE_FLAG_BACK_FACE, 0u);
                    EXPECT_TRUE(std::isfinite(s.normal.x + s.normal.y + s.normal.z + s.position.x));
                    EXPECT_NEAR(glm::length(s.normal), 1.0f, 1e-4f);
                    const double near = nearness(rays[i], s.distance, object_length);
                    const dvec3 p = ray.origin + double{s.distance} * ray.direction;
                    if (exact) {
                        EXPECT_LE(field(p), near);
                    } else if (!reference::has_both_sides(inside, p, 8.0 * near, 4000)) {
                        ++off;
                    }
                    const vec3 normal = expected_normal(examples()[e], p, near, world_from_object);
                    other_normal += !is_near(examples()[e], s.geometric_normal, normal);
                }
            }
            SCOPED_TRACE(std::string(examples()[e].name) + " spread " + std::to_string(spread));
            EXPECT_GT(hits, 100);
            EXPECT_LE(beyond, examples()[e].kind == ShapeKind::Mandelbulb ? 4 : 0);
            EXPECT_LE(off, hits / 20);
            EXPECT_LE(other_normal, allowed_normals(examples()[e], hits));
        }
    }
}

TEST_F(DistanceShapes, RaysFromInsideStopWhereTheyLeave) {
    constexpr float spread = 5e-4f;
    for (std::size_t e = 0; e < examples().size(); ++e) {
        SCOPED_TRACE(examples()[e].name);
        const bool exact = !examples()[e].estimated;
        const reference::Field field = field_of(examples()[e]);
        const reference::IsInside inside = reference::inside_of(field);
        int from_inside = 0, off = 0, early = 0, late = 0, other_normal = 0;
        for (std::size_t k = 0; k < transform_count; ++k) {
            const std::size_t instance = e * transform_count + k;
            const auto rays =
                rays_to(middle_of(e, k), static_cast<std::uint32_t>(100 + instance), 80, spread, true);
            const auto answers = rig_->answers(0, rays);
            const mat4 world_from_object = rig_->changes().shape_instances[instance].world_from_object;
            const double object_length = least_object_length(world_from_object);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const reference::Ray ray = in_object(rays[i], world_from_object);
                const shared::Surface& s = answers[i].surface;
                if (!inside(ray.origin)) continue;
                ++from_inside;
                EXPECT_EQ(s.kind, shared::SURFACE_VIRTUAL);
                EXPECT_EQ(answers[i].transmittance, vec3(0.0f));
                EXPECT_EQ(s.instance, instance);
                const auto truth = reference::first_side_change(ray, inside, 1e-3);
                ASSERT_TRUE(truth.has_value());
                const double near = nearness(rays[i], s.distance, object_length);
                const dvec3 p = ray.origin + double{s.distance} * ray.direction;
                early += s.distance < truth->distance - 1e-2;
                late += s.distance > truth->distance + 1e-4;
                const vec3 normal = expected_normal(examples()[e], p, near, world_from_object);
                other_normal += !is_near(examples()[e], s.geometric_normal, -normal);
                EXPECT_NE(s.flags & shared::SURFACE_FLAG_BACK_FACE, 0u);
                if (exact) {
                    EXPECT_NEAR(field(p), 0.0, near);
                } else if (!reference::has_both_sides(inside, p, 8.0 * near, 4000)) {
                    ++off;
                }
            }
        }
        EXPECT_GT(from_inside, 20);
        EXPECT_LE(off, from_inside / 50);
        EXPECT_LE(early, from_inside / 50);
        EXPECT_LE(late, from_inside / 50);  // past gaps thinner than a step
        EXPECT_LE(other_normal, allowed_normals(examples()[e], from_inside));
    }
}

TEST_F(DistanceShapes, RaysFromTheSurfaceHitOnlyWhatTheyGoInto) {
    for (std::size_t e = 0; e < examples().size(); ++e) {
        if (examples()[e].estimated) continue;
        SCOPED_TRACE(examples()[e].name);
        const std::vector<shared::TestRay> rays = rays_to(middle_of(e, 3), 100, 300, 4e-3f, false);
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
        EXPECT_LE(hit_again,
                  static_cast<int>(away.size()) / 25);  // in the grooves, where another wall is as near
        EXPECT_EQ(passed, 0);
    }
}

/// Position error is enough for a secondary ray not to start within the threshold.
TEST_F(DistanceShapes, LightLeavesTheSurface) {
    for (std::size_t e = 0; e < examples().size(); ++e) {
        SCOPED_TRACE(examples()[e].name);
        std::vector<shared::TestRay> rays;
        for (const shared::RayAnswer& answer :
             rig_->answers(0, rays_to(middle_of(e, 2), 100, 300, 2e-3f, false))) {
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
        EXPECT_LE(blocked, static_cast<int>(rays.size()) / 15);  // fractals are rough
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
    const std::vector<shared::TestRay> rays = rays_to(vec3(0.0f), 100, 200, 1e-3f, false);
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
        const std::vector<shared::TestRay> rays = rays_to(vec3(0.0f), 100, 400, spread, false);
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
