// Area lights against their closed forms, and adaptive shadows against all samples.
#include <algorithm>
#include <cmath>

#include "base/headset_profile.h"
#include "render/scene/load_scene.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/shadow_quality.h"
#include "tests/render/light/test_scene.h"

namespace foveray::render {
namespace {

using AreaLightTest = fakes::GpuTest;
using glm::dvec3;
using scene::AreaLightShape;

/// Irradiance on a point whose normal is n, from light of radiance 1 in the directions where `shines`, by
/// summing over the hemisphere.
template <typename Shines>
double irradiance_from(dvec3 n, Shines shines) {
    constexpr int rows = 400, columns = 1600;
    const dvec3 t = glm::normalize(glm::cross(n, dvec3(0.31, 0.42, 0.85))), b = glm::cross(n, t);
    double sum = 0.0;
    for (int i = 0; i < rows; ++i) {
        // Equal steps of the squared sine: each direction counts alike.
        const double sine_2 = (i + 0.5) / rows, sine = std::sqrt(sine_2), cosine = std::sqrt(1.0 - sine_2);
        for (int j = 0; j < columns; ++j) {
            const double angle = 2.0 * double{pi} * (j + 0.5) / columns;
            sum += shines(sine * (std::cos(angle) * t + std::sin(angle) * b) + cosine * n);
        }
    }
    return double{pi} * sum / (rows * columns);
}

/// What the floor receives at a few points of a light alone: the difference of a white and a black floor is
/// its diffuse part.
struct Received {
    std::vector<dvec3> points;
    std::vector<double> irradiance;  // for radiance 1
};

Received received(const gpu::Device& device, const scene::AreaLight& light, const Pose& pose) {
    Shot shot;
    shot.views = {square_view(25.0f, 5, look_at({0.0f, 2.0f, 0.0f}, vec3(0.0f)))};
    shot.settings.ambient_occlusion_samples = 0;
    std::vector<Rendered> rendered;
    for (const float albedo : {1.0f, 0.0f}) {
        TestScene world;
        world.add(scene::make_rectangle(vec2(3.0f)), matte(vec3(albedo)));
        world.add(light, pose);
        const scene::Scene scene = world.build();
        rendered.push_back(LightRig(device, scene).render(shot));
    }
    Received result;
    for (std::size_t i = 0; i < rendered[0].light.size(); ++i) {
        const dvec3 p(rendered[0].surfaces[i].position);
        const dvec3 view = glm::normalize(dvec3(0.0, 2.0, 0.0) - p);
        const dvec3 h = glm::normalize(glm::normalize(dvec3(pose.position) - p) + view);
        const double fresnel = 0.04 + 0.96 * std::pow(1.0 - glm::dot(view, h), 5.0);
        result.points.push_back(p);
        result.irradiance.push_back((rendered[0].light[i].radiance.x - rendered[1].light[i].radiance.x) *
                                    double{pi} / (1.0 - fresnel) / double{light.radiance.x});
    }
    return result;
}

TEST_F(AreaLightTest, SpheresGiveTheIrradianceOfASphere) {
    for (const vec3 center :
         {vec3(0.3f, 1.2f, 0.1f), vec3(0.7f, 0.1f, 0.2f)}) {  // the second is cut by the horizon
        const double radius = 0.35;
        const Received found = received(device(), {"lamp", AreaLightShape::Sphere, vec3(0.35f), vec3(2.0f)},
                                        Pose{.position = center});
        for (std::size_t i = 0; i < found.points.size(); ++i) {
            const dvec3 way = dvec3(center) - found.points[i];
            if (glm::length(way) < 1.5 * radius) continue;
            const double cosine = std::sqrt(1.0 - radius * radius / glm::dot(way, way));
            const double expected = irradiance_from(
                {0, 1, 0}, [&](dvec3 d) { return glm::dot(d, glm::normalize(way)) > cosine ? 1.0 : 0.0; });
            EXPECT_NEAR(found.irradiance[i], expected, 0.02 * expected + 3e-3) << i;
        }
    }
}

TEST_F(AreaLightTest, BoxesGiveTheIrradianceOfABox) {
    const dvec3 half(0.3, 0.15, 0.4);
    const Pose pose{glm::angleAxis(0.6f, glm::normalize(vec3(1.0f, 2.0f, 0.5f))), {0.2f, 0.9f, -0.1f}};
    const Received found = received(device(), {"lamp", AreaLightShape::Box, vec3(half), vec3(2.0f)}, pose);
    const glm::dmat3 box_from_world = glm::transpose(glm::mat3_cast(glm::dquat(pose.orientation)));
    for (std::size_t i = 0; i < found.points.size(); ++i) {
        const dvec3 origin = box_from_world * (found.points[i] - dvec3(pose.position));
        const double expected = irradiance_from({0, 1, 0}, [&](dvec3 world) {
            const dvec3 d = box_from_world * world, a = (-half - origin) / d, b = (half - origin) / d;
            const dvec3 first = glm::min(a, b), last = glm::max(a, b);
            const double entry = std::max({first.x, first.y, first.z}),
                         exit = std::min({last.x, last.y, last.z});
            return entry < exit && exit > 0.0 ? 1.0 : 0.0;
        });
        EXPECT_NEAR(found.irradiance[i], expected, 0.02 * expected + 3e-3) << i;
    }
}

// Bars thinner than the light, a ball and a box over a floor, under each shape of light.
TEST_F(AreaLightTest, AdaptiveShadowsAreAsGoodAsAllSamples) {
    for (const AreaLightShape shape :
         {AreaLightShape::Rectangle, AreaLightShape::Box, AreaLightShape::Sphere}) {
        TestScene world;
        world.add(scene::make_rectangle(vec2(3.0f)), matte(vec3(0.8f)));
        world.add(scene::make_box({0.02f, 0.02f, 0.6f}), matte(vec3(0.5f)),
                  {.position = {-0.5f, 0.5f, 0.0f}});
        world.add(scene::make_box({0.02f, 0.02f, 0.6f}), matte(vec3(0.5f)),
                  {.position = {-0.35f, 0.3f, 0.0f}});
        world.add(scene::make_sphere(0.2f, 16), matte(vec3(0.5f)), {.position = {0.4f, 0.35f, 0.2f}});
        world.add(scene::make_box({0.1f, 0.2f, 0.1f}), matte(vec3(0.5f)), {.position = {0.1f, 0.2f, -0.4f}});
        world.add(scene::AreaLight{"lamp", shape, {0.25f, 0.2f, 0.1f}, vec3(4.0f)},
                  look_at({0.3f, 1.8f, 0.2f}, vec3(0.0f)));
        const scene::Scene scene = world.build();
        Shot shot;
        shot.views = {square_view(28.0f, 32, look_at({0.0f, 1.5f, 1.2f}, vec3(0.0f)))};
        LightRig rig(device(), scene);
        expect_adaptive_as_good(rig, shot);
    }
}

// At the edges of sharp shadows neighbours disagree as in penumbras; there is nothing to be sampled there.
TEST_F(AreaLightTest, SharpShadowsAreNoPenumbras) {
    TestScene world;
    world.add(scene::make_rectangle(vec2(3.0f)), matte(vec3(0.8f)));
    world.add(scene::make_box({0.2f, 0.2f, 0.2f}), matte(vec3(0.5f)), {.position = {0.0f, 0.3f, 0.0f}});
    world.add(scene::Light{"lamp", scene::LightKind::Point, vec3(5.0f)},
              Pose{.position = {0.6f, 1.5f, 0.2f}});
    const scene::Scene scene = world.build();
    Shot shot;
    shot.views = {square_view(28.0f, 32, look_at({0.0f, 1.5f, 1.2f}, vec3(0.0f)))};
    LightRig rig(device(), scene);
    const Seen all = seen(rig, shot, 64, false), adaptive = seen(rig, shot, 64, true);
    EXPECT_EQ(all.part, adaptive.part);
    EXPECT_EQ(all.rays, adaptive.rays);
    EXPECT_GT(std::ranges::count(all.part, vec3(0.0f)), 20);
}

// HERR's hall: most of its surfaces lie in some penumbra of detailed objects.
TEST_F(AreaLightTest, AdaptiveShadowsAreAsGoodInHerrsHall) {
    const scene::Scene scene = scene::load_scene(assets_folder() / "scenes/herr.json");
    Shot shot;
    // As near to one another as samples are in the periphery: neighbours are asked.
    for (const vec3 target : {vec3(0.5f, 0.0f, 0.6f), vec3(-0.6f, 0.0f, 0.0f), vec3(0.3f, 0.7f, -1.2f)})
        shot.views.push_back(square_view(9.0f, 28, look_at({0.0f, 1.52f, 3.5f}, target)));
    LightRig rig(device(), scene);
    expect_adaptive_as_good(rig, shot);
}

}  // namespace
}  // namespace foveray::render
