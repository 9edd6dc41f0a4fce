#include "render/deform.h"

#include "render/scene/deform.h"
#include "render/scene/scene_builder.h"
#include "shaders/shared/ray_types.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/geometry/comparison.h"
#include "tests/render/geometry/scene_rig.h"

namespace foveray::render {
namespace {

using DeformTest = fakes::GpuTest;

/// A sheet in the xy plane, 2 m tall, whose upper half follows joint 1; two morph targets bulge and widen it.
scene::Mesh make_sheet(bool skinned, bool morphed) {
    constexpr std::uint32_t rows = 12, columns = 4;
    scene::Primitive p;
    for (std::uint32_t r = 0; r <= rows; ++r) {
        for (std::uint32_t c = 0; c <= columns; ++c) {
            const float x = static_cast<float>(c) / columns - 0.5f,
                        y = 2.0f * static_cast<float>(r) / rows - 1.0f;
            p.positions.emplace_back(x, y, 0.0f);
            p.normals.emplace_back(0, 0, 1);
            if (skinned) {
                const float upper = glm::smoothstep(-0.4f, 0.4f, y);
                p.joints.emplace_back(0, 1, 0, 1);
                p.weights.emplace_back(1 - upper, 0.7f * upper, 0.0f, 0.3f * upper);
            }
        }
    }
    for (std::uint32_t r = 0; r < rows; ++r) {
        for (std::uint32_t c = 0; c < columns; ++c) {
            const std::uint32_t a = r * (columns + 1) + c, b = a + columns + 1;
            for (const std::uint32_t i : {a, a + 1, b, b, a + 1, b + 1}) p.indices.push_back(i);
        }
    }
    if (morphed) {
        p.morph_targets.resize(2);
        for (const vec3 v : p.positions) {
            p.morph_targets[0].positions.emplace_back(0, 0, 0.5f * (1 - v.y * v.y));
            p.morph_targets[0].normals.emplace_back(0, v.y, 0);
            p.morph_targets[1].positions.emplace_back(v.x, 0, 0);
        }
    }
    scene::Mesh mesh;
    mesh.primitives.push_back(std::move(p));
    if (morphed) mesh.morph_weights = {0.0f, 0.5f};
    return mesh;
}

struct SheetOptions {
    bool skinned = false, morphed = false, mirrored = false;
};

scene::Scene make_scene(const SheetOptions& options) {
    scene::SceneBuilder builder;
    scene::Mesh mesh = make_sheet(options.skinned, options.morphed);
    scene::Material material;
    material.double_sided = !options.mirrored;
    mesh.primitives[0].material = builder.add(material);
    scene::Node root;
    root.local.translation = {0, 0, -3};
    root.local.rotation = glm::angleAxis(0.3f, vec3(0, 1, 0));
    root.local.scale = {options.mirrored ? -1.0f : 1.0f, 1.0f, 1.3f};
    const scene::NodeId root_id = builder.add(root);
    scene::Animation animation;
    scene::Node sheet;
    sheet.parent = root_id;
    sheet.mesh = builder.add(std::move(mesh));
    const scene::NodeId sheet_id = builder.add(sheet);
    if (options.skinned) {
        scene::Node joint;
        joint.parent = root_id;
        const scene::NodeId lower = builder.add(joint);
        joint.parent = lower;
        const scene::NodeId upper = builder.add(joint);
        builder.set_skin(sheet_id,
                         builder.add(scene::Skin{"skin", {lower, upper}, {mat4(1.0f), mat4(1.0f)}}));
        const quat bent = glm::angleAxis(1.2f, glm::normalize(vec3(1, 0.2f, 0.5f)));
        animation.channels.push_back({.node = upper,
                                      .property = scene::AnimatedProperty::Rotation,
                                      .interpolation = scene::Interpolation::Linear,
                                      .width = 4,
                                      .times = {0.0f, 1.0f},
                                      .values = {0, 0, 0, 1, bent.x, bent.y, bent.z, bent.w}});
    }
    if (options.morphed) {
        animation.channels.push_back({.node = sheet_id,
                                      .property = scene::AnimatedProperty::Weights,
                                      .interpolation = scene::Interpolation::Linear,
                                      .width = 2,
                                      .times = {0.0f, 1.0f},
                                      .values = {0, 0.5f, 1, -0.2f}});
    }
    builder.add(animation);
    return std::move(builder).build();
}

/// Where the reference says the point under a hit was in the frame before.
vec3 previous_position(const scene::Scene& scene, const scene::SceneChanges& changes,
                       const reference::Hit& hit) {
    const scene::Instance& instance = scene.instances[hit.object];
    const scene::DeformationState& state = changes.deformations[*instance.deformation];
    const scene::Primitive& p = scene.meshes[instance.mesh].primitives[hit.primitive];
    const auto before = scene::deform(p, state.previous_joints, state.previous_morph_weights).positions;
    const std::uint32_t* corner = &p.indices[3 * hit.triangle];
    const vec2 b = hit.barycentrics;
    const vec3 object =
        before[corner[0]] * (1 - b.x - b.y) + before[corner[1]] * b.x + before[corner[2]] * b.y;
    return vec3(changes.instances[hit.object].previous_world_from_object * vec4(object, 1.0f));
}

void check(const gpu::Device& device, const SheetOptions& options) {
    const scene::Scene scene = make_scene(options);
    ASSERT_EQ(scene.deformations.size(), 1u);
    SceneRig rig(device, scene);
    const View view = view_forward(25.0f, {32, 32});
    const auto directions = directions_of(view);
    for (const double time : {0.0, 0.3, 0.35, 0.8}) {
        const auto found = rig.surfaces(from_seconds(time), {&view, 1});
        const reference::Tracer tracer(scene, rig.changes());
        const Comparison result = compare(found, tracer, view);
        EXPECT_GT(result.hits, 100);
        EXPECT_LE(result.other_object, 6);
        for (std::size_t i = 0; i < found.size(); ++i) {
            const auto hit = tracer.closest({.origin = dvec3(0), .direction = directions[i]});
            if (!hit || found[i].kind != shared::SURFACE_VIRTUAL) continue;
            expect_near(found[i].previous_position, previous_position(scene, rig.changes(), *hit), 1e-3f,
                        "previous");
        }
        EXPECT_EQ(rig.masks().front(), shared::MASK_VIRTUAL | (time > 0.0 ? shared::MASK_MOVING : 0u));
    }
    // The same time again: nothing moves.
    for (const auto& s : rig.surfaces(from_seconds(0.8), {&view, 1})) {
        if (s.kind == shared::SURFACE_VIRTUAL) expect_near(s.previous_position, s.position, 1e-6f, "at rest");
    }
    EXPECT_EQ(rig.masks().front(), shared::MASK_VIRTUAL);
}

TEST_F(DeformTest, skinnedMeshesAgreeWithTheReference) { check(device(), {.skinned = true}); }
TEST_F(DeformTest, morphedMeshesAgreeWithTheReference) { check(device(), {.morphed = true}); }
TEST_F(DeformTest, skinnedAndMorphedMeshesAgreeWithTheReference) {
    check(device(), {.skinned = true, .morphed = true});
}

TEST_F(DeformTest, structuresStayRightThroughRefitsAndRebuilds) {
    const scene::Scene scene = make_scene({.skinned = true, .morphed = true});
    SceneRig rig(device(), scene);
    const View view = view_forward(25.0f, {12, 12});
    const auto triangles = static_cast<std::uint32_t>(scene.meshes[0].primitives[0].indices.size() / 3);
    const std::uint32_t refits = RebuildPlan::refits_between_builds(triangles);
    ASSERT_GT(refits, 0u);
    for (std::uint32_t i = 0; i <= refits + 1; ++i) {
        const auto found = rig.surfaces(from_seconds(i / 40.0), {&view, 1});
        if (i < refits - 1) continue;
        EXPECT_LE(compare(found, reference::Tracer(scene, rig.changes()), view).other_object, 2);
    }
}

TEST_F(DeformTest, mirroredJointsKeepTheFrontInFront) {
    const scene::Scene scene = make_scene({.skinned = true, .mirrored = true});
    SceneRig rig(device(), scene);
    const View view = view_forward(3.0f, {4, 4});
    for (const auto& s : rig.surfaces(0, {&view, 1})) {
        ASSERT_EQ(s.kind, shared::SURFACE_VIRTUAL);
        EXPECT_EQ(s.flags, 0u);
        EXPECT_GT(s.normal.z, 0.5f);
    }
}

}  // namespace
}  // namespace foveray::render
