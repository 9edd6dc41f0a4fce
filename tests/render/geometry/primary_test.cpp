#include "render/primary.h"

#include <cmath>

#include "render/scene/scene_builder.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/geometry/comparison.h"
#include "tests/render/geometry/random_scene.h"
#include "tests/render/geometry/scene_rig.h"

namespace foveray::render {
namespace {

using PrimaryTest = fakes::GpuTest;

TEST_F(PrimaryTest, agreesWithTheReferenceOnRandomScenes) {
    int back_faces = 0;
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        const scene::Scene scene = random_scene(seed).build();
        SceneRig rig(device(), scene);
        View view = view_forward(45.0f, {48, 48});
        view.stage_from_eye = {glm::angleAxis(0.1f * static_cast<float>(seed), vec3(0.2f, 0.9f, 0.1f)),
                               {0.1f, -0.2f, 0.3f}};
        view.stage_from_eye.orientation = glm::normalize(view.stage_from_eye.orientation);
        const auto found = rig.surfaces(0, {&view, 1});
        const reference::Tracer tracer(scene, rig.changes());
        const Comparison result = compare(found, tracer, view);
        EXPECT_GT(result.hits, result.compared / 4);
        back_faces += result.back_faces;
        EXPECT_LE(result.other_object, 5);
        EXPECT_EQ(rig.counts()[shared::COUNT_PRIMARY], found.size());
    }
    EXPECT_GT(back_faces, 50);
}

/// OpenXR's projection, written from the angles' meaning: a point at the tangent of angleLeft is on the left
/// edge.
vec2 pixel_of(const View& view, vec3 point) {
    const vec3 p = glm::conjugate(view.stage_from_eye.orientation) * (point - view.stage_from_eye.position);
    const double left = std::tan(double{view.fov.left}), right = std::tan(double{view.fov.right});
    const double up = std::tan(double{view.fov.up}), down = std::tan(double{view.fov.down});
    const glm::dmat4 projection = glm::transpose(glm::dmat4(          //
        2.0 / (right - left), 0, (right + left) / (right - left), 0,  //
        0, 2.0 / (up - down), (up + down) / (up - down), 0,           //
        0, 0, -1, -0.1,                                               //
        0, 0, -1, 0));
    const glm::dvec4 clip = projection * glm::dvec4(glm::dvec3(p), 1.0);
    const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;  // y up
    return {(ndc.x + 1.0) / 2.0 * view.size.x, (1.0 - ndc.y) / 2.0 * view.size.y};
}

TEST_F(PrimaryTest, hitsProjectOntoTheirOwnPixels) {
    const scene::Scene scene = random_scene(7).build();
    SceneRig rig(device(), scene);
    std::array<View, 4> views;
    views[0].fov = {-0.9f, 0.7f, 0.6f, -0.8f};
    views[1].fov = {-0.7f, 0.9f, 0.6f, -0.8f};
    views[2].fov = {-0.1f, 0.4f, 0.35f, -0.02f};
    views[3].fov = {-0.4f, -0.05f, 0.02f, -0.3f};
    const std::array<uvec2, 4> sizes = {uvec2(40, 36), uvec2(36, 40), uvec2(50, 31), uvec2(33, 44)};
    for (std::size_t i = 0; i < 4; ++i) {
        views[i].size = sizes[i];
        const float side = i % 2 == 0 ? -1.0f : 1.0f;
        views[i].stage_from_eye.position = {0.032f * side, 0.1f, 0.2f};
        views[i].stage_from_eye.orientation = glm::normalize(quat(0.99f, 0.05f, 0.04f * side, 0.03f));
    }
    const auto found = rig.surfaces(0, views);
    std::size_t sample = 0;
    int hits = 0;
    for (const View& view : views) {
        for (std::uint32_t y = 0; y < view.size.y; ++y) {
            for (std::uint32_t x = 0; x < view.size.x; ++x, ++sample) {
                if (found[sample].kind != shared::SURFACE_VIRTUAL) continue;
                ++hits;
                const vec2 offset = pixel_of(view, found[sample].position) - (vec2(x, y) + 0.5f);
                EXPECT_LT(glm::length(offset), 0.1f);
            }
        }
    }
    EXPECT_GT(hits, 1000);
}

TEST_F(PrimaryTest, previousPositionsFollowAnimatedNodes) {
    scene::SceneBuilder builder;
    scene::Node node;
    node.mesh = builder.add(scene::make_rectangle(vec2(1.0f)));
    node.local.rotation = glm::angleAxis(pi / 2, vec3(1, 0, 0));
    node.local.translation = {0, 0, -3};
    const scene::NodeId id = builder.add(node);
    scene::Animation animation;
    animation.channels.push_back({.node = id,
                                  .property = scene::AnimatedProperty::Translation,
                                  .interpolation = scene::Interpolation::Linear,
                                  .width = 3,
                                  .times = {0.0f, 1.0f},
                                  .values = {0, 0, -3, 1, 0, -3}});
    builder.add(animation);
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    const View view = view_forward(5.0f, {4, 4});
    for (const shared::Surface& s : rig.surfaces(0, {&view, 1})) {
        expect_near(s.previous_position, s.position, 1e-6f, "first frame");
    }
    for (const double time : {0.25, 0.75}) {
        const float step = time == 0.25 ? 0.25f : 0.5f;
        for (const shared::Surface& s : rig.surfaces(from_seconds(time), {&view, 1})) {
            ASSERT_EQ(s.kind, shared::SURFACE_VIRTUAL);
            expect_near(s.previous_position, s.position - vec3(step, 0, 0), 1e-5f, "motion");
        }
    }
}

TEST_F(PrimaryTest, nothingToSeeIsAllMisses) {
    scene::SceneBuilder builder;
    scene::Node node;  // of a mesh whose primitives were all points, say
    node.mesh = builder.add(scene::Mesh{});
    builder.add(node);
    const scene::Scene scene = std::move(builder).build();
    SceneRig rig(device(), scene);
    const View view = view_forward(30.0f, {8, 8});
    for (const shared::Surface& s : rig.surfaces(0, {&view, 1})) EXPECT_EQ(s.kind, shared::SURFACE_NONE);
    const scene::Scene empty = scene::SceneBuilder().build();
    SceneRig empty_rig(device(), empty);
    for (const shared::Surface& s : empty_rig.surfaces(0, {&view, 1}))
        EXPECT_EQ(s.kind, shared::SURFACE_NONE);
}

}  // namespace
}  // namespace foveray::render
