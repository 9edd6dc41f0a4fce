// See-through shapes: rays go on behind them, light comes through them in their colour.
#include <cmath>

#include "render/reference/tracer.h"
#include "render/scene/scene_builder.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/geometry/scene_rig.h"
#include "tests/render/shapes/ray_rig.h"

namespace foveray::render {
namespace {

using scene::ShapeKind;

constexpr float alpha = 0.4f;
constexpr uvec2 size(24, 24);

scene::Material glass(vec3 color) {
    scene::Material material;
    material.base_color = vec4(color, alpha);
    material.alpha_mode = scene::AlphaMode::Blend;
    material.double_sided = true;
    material.unlit = true;
    return material;
}

scene::Material opaque(vec3 color) {
    scene::Material material;
    material.base_color = vec4(color, 1.0f);
    material.unlit = true;
    return material;
}

/// A default shape of that kind, made of few and smooth surfaces.
scene::Shape smooth_shape(ShapeKind kind) {
    scene::Shape shape;
    shape.kind = kind;
    shape.values = scene::default_values(scene::shape_kind(kind).parameters);
    if (kind == ShapeKind::Csg) {
        const mat4 small =
            glm::translate(mat4(1.0f), vec3(0.2f, 0.1f, 0.3f)) * glm::scale(mat4(1.0f), vec3(0.3f));
        shape.solid.leaves = {{scene::CsgPrimitive::Sphere, glm::scale(mat4(1.0f), vec3(0.5f)), {}},
                              {scene::CsgPrimitive::Sphere, small, {}}};
        shape.solid.program = {{std::nullopt, 0}, {std::nullopt, 1}, {scene::CsgOperation::Difference, 0}};
    }
    if (kind == ShapeKind::Blend) {
        shape.blend_parts.resize(2);
        shape.blend_parts[0].primitive = scene::BlendPrimitive::Torus;
        shape.blend_parts[0].size = {0.4f, 0.12f, 0.0f};
        shape.blend_parts[1].size.x = 0.3f;
        shape.blend_parts[1].object_from_part.translation = {0.0f, 0.3f, 0.0f};
    }
    if (const auto at = scene::parameter_offset(scene::shape_kind(kind).parameters, "iterations"))
        shape.values[*at] = 2.0f;
    return shape;
}

void place(scene::SceneBuilder& builder, scene::Shape shape, const scene::Material& material,
           const scene::Transform& at) {
    shape.material = builder.add(material);
    scene::Node node;
    node.local = at;
    node.shape = builder.add(std::move(shape));
    builder.add(node);
}

/// How many surfaces of glass let so much through.
int surfaces(double through) {
    return static_cast<int>(std::lround(std::log(through) / std::log(1.0 - double{alpha})));
}

using SeeThroughTest = fakes::GpuTest;

/// Not too few surfaces and not one twice: by rays that go on behind what they met, and by shadow rays.
TEST_F(SeeThroughTest, EverySurfaceIsMetOnce) {
    struct Case {
        ShapeKind kind;
        double off;  // part of the rays that may graze a surface, or pass what is thinner than their cone
    };
    const std::vector<Case> cases = {{ShapeKind::Sphere, 0.0}, {ShapeKind::Box, 0.0},
                                     {ShapeKind::Csg, 0.0},    {ShapeKind::Blend, 0.1},
                                     {ShapeKind::Julia, 0.01}, {ShapeKind::Mandelbulb, 0.3}};
    // One beside the other round the eye.
    const auto turn = [](std::size_t i) {
        return glm::angleAxis(0.8f * static_cast<float>(i), vec3(0, 1, 0));
    };
    scene::SceneBuilder builder;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        scene::Transform at;
        at.translation = turn(i) * vec3(0, 0, -4);
        at.rotation = glm::normalize(quat(0.9f, 0.3f, 0.2f, 0.1f));
        place(builder, smooth_shape(cases[i].kind), glass(vec3(1.0f)), at);
    }
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    RayRig ray_rig(device(), scene);
    Settings settings;
    settings.max_transparent_layers = 16;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        SCOPED_TRACE(scene::shape_kind(cases[i].kind).name);
        View view = view_forward(7.0f, size);
        view.stage_from_eye.orientation = turn(i);
        const std::vector<vec4> picture = rig.picture(0, view, settings);
        std::vector<shared::TestRay> rays;
        for (const dvec3& direction : directions_of(view)) {
            shared::TestRay ray{};
            ray.direction = vec3(glm::normalize(direction));
            ray.t_max = ray.shadow_t_max = 100.0f;
            ray.cone = {0.0f, radians(14.0f) / static_cast<float>(size.x)};
            rays.push_back(ray);
        }
        const auto answers = ray_rig.answers(0, rays);
        const reference::Tracer tracer(scene, rig.changes());
        int met = 0, other_seen = 0, other_shadow = 0;
        for (std::size_t k = 0; k < rays.size(); ++k) {
            const int expected =
                surfaces(tracer.transmittance({.origin = dvec3(0.0), .direction = dvec3(rays[k].direction)}));
            met += expected > 0;
            other_seen += surfaces(1.0 - double{picture[k].a}) != expected;
            other_shadow += surfaces(double{answers[k].transmittance.g}) != expected;
        }
        const double most = cases[i].off * static_cast<double>(rays.size());
        EXPECT_GT(met, 200);
        EXPECT_LE(other_seen, most);
        EXPECT_LE(other_shadow, 1.2 * most);
    }
}

TEST_F(SeeThroughTest, ASphereShowsWhatIsBehindIt) {
    const vec3 blue(0.2f, 0.6f, 0.9f), red(0.8f, 0.1f, 0.05f);
    scene::SceneBuilder builder;
    scene::Transform at;
    at.translation = {0, 0, -4};
    place(builder, smooth_shape(ShapeKind::Sphere), glass(blue), at);
    at.translation = {0, 0, -8};
    place(builder, smooth_shape(ShapeKind::Box), opaque(red), at);
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    const vec4 pixel = rig.picture(0, view_forward(1.0f, uvec2(3)), Settings{})[4];
    const float through = 1.0f - alpha;
    const vec3 expected = alpha * blue + through * alpha * blue + through * through * red;
    EXPECT_LT(glm::distance(vec3(pixel), expected), 2e-3f);
    EXPECT_NEAR(pixel.a, 1.0f, 1e-3f);
}

/// A wall in the light of a sun, where a sphere beside the picture throws its shadow if it stands between
/// them.
vec3 wall_in_shadow_of(const gpu::Device& device, const scene::Material& material, bool between) {
    scene::SceneBuilder builder;
    scene::Material white;
    white.roughness = 1.0f;
    scene::Shape wall = smooth_shape(ShapeKind::Box);
    wall.values = {3.0f, 3.0f, 0.5f};
    scene::Transform at;
    at.translation = {0, 0, -6.5f};
    place(builder, wall, white, at);
    at.translation = {between ? 1.5f : 5.0f, 0, -4};
    place(builder, smooth_shape(ShapeKind::Sphere), material, at);
    scene::Node sun;
    scene::Light light;
    light.kind = scene::LightKind::Directional;
    sun.light = builder.add(light);
    sun.local.rotation = glm::angleAxis(std::asin(0.6f), vec3(0, 1, 0));
    builder.add(sun);
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device, scene);
    Settings settings;
    settings.environment_intensity = 0.0f;
    return vec3(rig.picture(0, view_forward(1.0f, uvec2(3)), settings)[4]);
}

TEST_F(SeeThroughTest, ASphereTintsItsShadow) {
    const vec3 blue(0.2f, 0.6f, 0.9f);
    const vec3 lit = wall_in_shadow_of(device(), glass(blue), false);
    ASSERT_GT(lit.r, 0.05f);
    EXPECT_EQ(wall_in_shadow_of(device(), opaque(blue), true), vec3(0.0f));
    const vec3 tinted = wall_in_shadow_of(device(), glass(blue), true) / lit;
    const vec3 once = (1.0f - alpha) * glm::mix(vec3(1.0f), blue, alpha);
    EXPECT_LT(glm::distance(tinted, once * once), 2e-3f);
}

}  // namespace
}  // namespace foveray::render
