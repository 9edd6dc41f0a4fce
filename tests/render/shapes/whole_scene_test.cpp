// Whole scenes of shapes, fractals, blends and voxels: small pictures and their shadows against the
// reference.
#include <cmath>
#include <map>
#include <set>

#include "base/headset_profile.h"
#include "render/reference/tracer.h"
#include "render/scene/load_scene.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/shapes/ray_rig.h"

namespace foveray::render {
namespace {

using scene::ShapeKind;

constexpr int width = 48, height = 36;
// A ray's cone is this wide a metre. It counts a surface as hit from a quarter of that, and voxels stay
// whole.
constexpr float spread = 2e-4f;

/// Surfaces that are found by a march end within the cone and the march's rounding, and rays that graze them,
/// or a fractal's dust, may take either.
bool is_marched(ShapeKind kind) {
    return kind == ShapeKind::Julia || kind == ShapeKind::Mandelbulb || kind == ShapeKind::Blend;
}

/// From the scene's camera through the middle of every pixel.
std::vector<shared::TestRay> camera_rays(const scene::Scene& scene, const scene::SceneChanges& now) {
    std::size_t node = 0;
    while (!scene.nodes[node].camera) ++node;
    const mat4 world_from_camera = now.world_from_node[node];
    const float up = std::tan(0.5f * scene.cameras[*scene.nodes[node].camera].vertical_fov);
    std::vector<shared::TestRay> rays;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float right = up * static_cast<float>(2 * x + 1 - width) / static_cast<float>(height);
            const float above = up * static_cast<float>(height - 2 * y - 1) / static_cast<float>(height);
            shared::TestRay ray{};
            ray.origin = vec3(world_from_camera[3]);
            ray.direction = glm::normalize(mat3(world_from_camera) * vec3(right, above, -1.0f));
            ray.t_max = ray.shadow_t_max = 100.0f;
            ray.cone = {0.0f, spread};
            rays.push_back(ray);
        }
    }
    return rays;
}

reference::Ray exact(const shared::TestRay& ray, float farthest) {
    return {.origin = ray.origin, .direction = ray.direction, .nearest = 0.0, .farthest = double{farthest}};
}

struct Count {
    int rays = 0, other_thing = 0, other_distance = 0, other_normal = 0, other_color = 0, other_side = 0;
};

/// One moment of a scene, by kind of what the reference meets.
struct Comparison {
    std::map<ShapeKind, Count> seen;
    int misses = 0, other_misses = 0;
    int shadowed = 0, lit = 0, other_shadow = 0;
};

Comparison compare(const gpu::Device& device, const scene::Scene& scene, Nanoseconds time) {
    RayRig rig(device, scene);
    scene::SceneAnimator animator(scene);
    const scene::SceneChanges& now = animator.advance(time);
    const reference::Tracer tracer(scene, now);
    const std::vector<shared::TestRay> rays = camera_rays(scene, now);
    const auto answers = rig.answers(time, rays);
    Comparison result;
    std::vector<shared::TestRay> to_light;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const shared::Surface& s = answers[i].surface;
        const auto hit = tracer.closest(exact(rays[i], rays[i].t_max), reference::Side::FrontOnly);
        if (!hit) {
            ++result.misses;
            result.other_misses += s.kind != shared::SURFACE_NONE;
            continue;
        }
        const ShapeKind kind = scene.shapes[scene.shape_instances[hit->object].shape].kind;
        Count& count = result.seen[kind];
        ++count.rays;
        if (s.kind != shared::SURFACE_VIRTUAL || s.instance != hit->object) {
            ++count.other_thing;
            continue;
        }
        const double tolerance = is_marched(kind) ? 5e-3 : 1e-4;
        if (std::abs(double{s.distance} - hit->distance) > tolerance * hit->distance) {
            ++count.other_distance;
            continue;
        }
        const vec3 normal = (hit->front ? 1.0f : -1.0f) * hit->geometric_normal;
        count.other_side += (s.flags & shared::SURFACE_FLAG_BACK_FACE) == 0 ? !hit->front : hit->front;
        count.other_normal += glm::dot(s.geometric_normal, normal) < (is_marched(kind) ? 0.95f : 0.9999f);
        count.other_color += glm::length(s.base_color - vec3(hit->base_color)) > 0.03f;
        shared::TestRay light = rays[i];
        const vec3 off = vec3(hit->position) + (2e-3f * s.distance + s.position_error) * normal;
        const vec3 way = now.area_lights.front().center - off;
        if (glm::dot(way, normal) <= 0.0f) continue;
        light.origin = off;
        light.direction = glm::normalize(way);
        light.shadow_t_max = glm::length(way);
        light.cone.width = spread * s.distance;
        to_light.push_back(light);
    }
    const auto shadows = rig.answers(time, to_light);
    for (std::size_t i = 0; i < to_light.size(); ++i) {
        const double through = tracer.transmittance(exact(to_light[i], to_light[i].shadow_t_max));
        ++(through < 1.0 ? result.shadowed : result.lit);
        // The light through what is see-through is also tinted, which the reference leaves out.
        result.other_shadow += std::abs(double{shadows[i].transmittance.b} - through) > 0.05;
    }
    return result;
}

/// Of closed forms and voxels a ray in a hundred may graze an edge. Of fractals one in ten may end at another
/// distance and one in five have another normal and colour: their surface is rough at every scale.
void expect_agreement(const Comparison& c, bool fine_fractals) {
    for (const auto& [kind, n] : c.seen) {
        SCOPED_TRACE(scene::shape_kind(kind).name);
        const int few = 1 + n.rays / 100, some = 1 + n.rays / 10;
        EXPECT_GT(n.rays, 15);
        EXPECT_LE(n.other_thing, few);
        EXPECT_LE(n.other_distance, is_marched(kind) ? some : 0);
        EXPECT_EQ(n.other_side, 0);
        // Finer than the rays' cones, a Mandelbulb's normals and colours are noise.
        if (kind == ShapeKind::Mandelbulb && fine_fractals) continue;
        EXPECT_LE(n.other_normal, is_marched(kind) ? 2 * some : few);
        EXPECT_LE(n.other_color, is_marched(kind) ? 2 * some : few);
    }
    EXPECT_LE(c.other_misses, c.misses / 50);
    EXPECT_GT(c.misses, 100);
    EXPECT_LE(c.other_shadow, (c.lit + c.shadowed) / 50);
    EXPECT_GT(c.shadowed, 100);
    EXPECT_GT(c.lit, 100);
}

using WholeSceneTest = fakes::GpuTest;

TEST_F(WholeSceneTest, ThePapersSceneWhileItMoves) {
    const scene::Scene scene = scene::load_scene(assets_folder() / "scenes/proceduray.json");
    expect_agreement(compare(device(), scene, from_seconds(1.3)), true);
}

TEST_F(WholeSceneTest, ThePapersSceneWithSmoothFractals) {
    scene::Scene scene = scene::load_scene(assets_folder() / "scenes/proceduray.json");
    for (scene::Shape& shape : scene.shapes) {
        const auto& kind = scene::shape_kind(shape.kind);
        if (const auto at = scene::parameter_offset(kind.parameters, "iterations")) shape.values[*at] = 2.0f;
    }
    expect_agreement(compare(device(), scene, 0), false);
}

TEST_F(WholeSceneTest, EveryShape) {
    const scene::Scene scene = scene::load_scene(assets_folder() / "scenes/shapes.json");
    const Comparison comparison = compare(device(), scene, 0);
    std::set<scene::ShapeKind> kinds;
    for (const scene::Shape& shape : scene.shapes) kinds.insert(shape.kind);
    EXPECT_GE(kinds.size(), 9u);
    EXPECT_EQ(comparison.seen.size(), kinds.size());
    expect_agreement(comparison, true);
}

}  // namespace
}  // namespace foveray::render
