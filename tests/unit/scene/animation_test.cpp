#include "render/scene/animator.h"
#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

using fakes::GltfBuilder;

AnimationChannel channel(AnimatedProperty property, Interpolation interpolation, std::uint32_t width,
                         std::vector<float> times, std::vector<float> values) {
    return {.node = 0,
            .property = property,
            .interpolation = interpolation,
            .width = width,
            .times = std::move(times),
            .values = std::move(values)};
}

TEST(Sample, linearStepAndEnds) {
    const auto linear =
        channel(AnimatedProperty::Translation, Interpolation::Linear, 3, {1, 3}, {0, 0, 0, 4, 8, -2});
    EXPECT_EQ(sample(linear, 0.0f), (std::vector<float>{0, 0, 0}));
    EXPECT_EQ(sample(linear, 1.5f), (std::vector<float>{1, 2, -0.5f}));
    EXPECT_EQ(sample(linear, 9.0f), (std::vector<float>{4, 8, -2}));
    AnimationChannel step = linear;
    step.interpolation = Interpolation::Step;
    EXPECT_EQ(sample(step, 2.99f), (std::vector<float>{0, 0, 0}));
    EXPECT_EQ(sample(step, 3.0f), (std::vector<float>{4, 8, -2}));
}

TEST(Sample, rotationsTakeTheShortestArc) {
    // From a turn of 0 to a turn of 90 degrees about z, the second key with the quaternion's sign flipped.
    const float h = std::sqrt(0.5f);
    const auto turn =
        channel(AnimatedProperty::Rotation, Interpolation::Linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, -h, -h});
    const auto q = sample(turn, 1.0f / 3.0f);
    const vec3 turned = quat(q[3], q[0], q[1], q[2]) * vec3(1, 0, 0);
    expect_near(turned, {std::cos(pi / 6), std::sin(pi / 6), 0});
}

TEST(Sample, cubicSplineIsTheHermitePolynomial) {
    // x(t) = t^3 over [0, 2]: tangents 3 t^2, so 0 at the first key and 12 at the second.
    const auto cubic = channel(AnimatedProperty::Translation, Interpolation::CubicSpline, 3, {0, 2},
                               {9, 9, 9, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 0, 0, 9, 9, 9});
    for (const float t : {0.0f, 0.5f, 1.0f, 1.7f, 2.0f}) EXPECT_NEAR(sample(cubic, t)[0], t * t * t, 1e-5f);
}

TEST(Sample, cubicSplineRotationsAreNormalised) {
    const float h = std::sqrt(0.5f);
    const auto turn = channel(AnimatedProperty::Rotation, Interpolation::CubicSpline, 4, {0, 1},
                              {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, h, h, 0, 0, 0, 0});
    const auto q = sample(turn, 0.5f);
    EXPECT_NEAR(std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), 1.0f, 1e-6f);
    EXPECT_NEAR(2.0f * std::atan2(q[2], q[3]), pi / 4, 1e-5f);
}

class Animated : public GltfTest {
  protected:
    /// The triangle moves from x = 0 to x = 2 in 2 seconds.
    static GltfBuilder moving() {
        GltfBuilder gltf = GltfBuilder::triangle();
        add_translation(gltf, {0, 0, 0, 2, 0, 0});
        return gltf;
    }
    static void add_translation(GltfBuilder& gltf, const std::vector<float>& values) {
        const int times = gltf.add_accessor<float>({0, 2}, "SCALAR");
        const int output = gltf.add_accessor<float>(values, "VEC3");
        gltf.add("animations",
                 {{"name", "move"},
                  {"samplers", {{{"input", times}, {"output", output}}}},
                  {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    }
};

TEST_F(Animated, instancesMoveAndRememberTheirLastPlace) {
    const Scene scene = load(moving());
    SceneAnimator animator(scene);
    const SceneChanges& now = animator.advance(from_seconds(0.5));
    EXPECT_TRUE(now.transforms_changed);
    EXPECT_FALSE(now.instances[0].moved);
    expect_near(vec3(now.instances[0].world_from_object[3]), {0.5f, 0, 0});
    expect_near(vec3(now.instances[0].previous_world_from_object[3]), {0.5f, 0, 0});
    animator.advance(from_seconds(1.0));
    EXPECT_TRUE(now.instances[0].moved);
    EXPECT_TRUE(now.transforms_changed);
    expect_near(vec3(now.instances[0].world_from_object[3]), {1, 0, 0});
    expect_near(vec3(now.instances[0].previous_world_from_object[3]), {0.5f, 0, 0});
    expect_near(vec3(now.previous_world_from_node[0][3]), {0.5f, 0, 0});
    animator.advance(from_seconds(1.0));
    EXPECT_FALSE(now.instances[0].moved);
    EXPECT_FALSE(now.transforms_changed);
}

TEST_F(Animated, loops) {
    const Scene scene = load(moving());
    EXPECT_EQ(scene.animations[0].duration, 2.0f);
    SceneAnimator animator(scene);
    expect_near(vec3(animator.advance(from_seconds(7.25)).instances[0].world_from_object[3]), {1.25f, 0, 0});
    // Far into a long session it is as precise as at its start.
    expect_near(vec3(animator.advance(from_seconds(200001.25)).instances[0].world_from_object[3]),
                {1.25f, 0, 0});
}

TEST_F(Animated, canBeSwitchedOff) {
    GltfModel::Use use;
    use.animate = false;
    EXPECT_TRUE(load(moving(), use).animations.empty());
}

TEST_F(Animated, aSecondAnimationOfTheSameNodeDoesNotPlay) {
    GltfBuilder gltf = moving();
    add_translation(gltf, {0, 0, 0, 0, 9, 0});
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.animations.size(), 1u);
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST_F(Animated, morphWeights) {
    GltfBuilder gltf = GltfBuilder::triangle();
    const int delta = gltf.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    gltf.primitive()["targets"] = Json::array({{{"POSITION", delta}}, {{"POSITION", delta}}});
    gltf.json["meshes"][0]["weights"] = {0.5, 0};
    const int times = gltf.add_accessor<float>({0, 1, 2}, "SCALAR");
    const int weights = gltf.add_accessor<float>({0, 1, 1, 0, 1, 0}, "SCALAR");
    gltf.add("animations",
             {{"samplers", {{{"input", times}, {"output", weights}}}},
              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.deformations.size(), 1u);
    EXPECT_TRUE(scene.deformations[0].animated);
    SceneAnimator animator(scene);
    const SceneChanges& now = animator.advance(from_seconds(0.25));
    EXPECT_TRUE(now.deformations[0].changed);
    EXPECT_EQ(now.deformations[0].morph_weights, (std::vector<float>{0.25f, 0.75f}));
    EXPECT_EQ(now.deformations[0].previous_morph_weights, (std::vector<float>{0.25f, 0.75f}));
    animator.advance(from_seconds(1.25));
    EXPECT_EQ(now.deformations[0].morph_weights, (std::vector<float>{1, 0}));
    EXPECT_EQ(now.deformations[0].previous_morph_weights, (std::vector<float>{0.25f, 0.75f}));
    animator.advance(from_seconds(1.5));
    EXPECT_FALSE(now.deformations[0].changed);
    EXPECT_FALSE(now.instances[0].moved);
}

TEST(AnimatedSkin, jointsMoveTheSkin) {
    SceneBuilder builder;
    Mesh mesh = make_box(vec3(1));
    Primitive& p = mesh.primitives[0];
    p.joints.assign(p.positions.size(), {0, 0, 0, 0});
    p.weights.assign(p.positions.size(), {1, 0, 0, 0});
    Node joint, body;
    body.mesh = builder.add(mesh);
    const NodeId joint_id = builder.add(joint), body_id = builder.add(body);
    Skin skin;
    skin.joints = {joint_id};
    skin.inverse_bind = {glm::translate(mat4(1), vec3(0, 0, 1))};
    builder.set_skin(body_id, builder.add(skin));
    Animation animation;
    animation.channels = {
        channel(AnimatedProperty::Translation, Interpolation::Linear, 3, {0, 1}, {0, 0, 0, 4, 0, 0})};
    builder.add(animation);
    const Scene scene = std::move(builder).build();
    ASSERT_EQ(scene.deformations.size(), 1u);
    EXPECT_TRUE(scene.deformations[0].animated);
    SceneAnimator animator(scene);
    animator.advance(0);
    const SceneChanges& now = animator.advance(from_seconds(0.5));
    expect_near(transform(now.deformations[0].joints[0], {0, 0, 0}), {2, 0, 1});
    expect_near(transform(now.deformations[0].previous_joints[0], {0, 0, 0}), {0, 0, 1});
    EXPECT_TRUE(now.deformations[0].changed);
}

}  // namespace
}  // namespace foveray::scene
