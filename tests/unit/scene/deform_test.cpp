#include "render/scene/deform.h"

#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

Primitive two_points() {
    Primitive p;
    p.positions = {{1, 0, 0}, {0, 1, 0}};
    p.normals = {{1, 0, 0}, {0, 1, 0}};
    p.tangents = {{0, 1, 0, -1}, {1, 0, 0, 1}};
    return p;
}

TEST(Deform, withoutAnythingNothingChanges) {
    const DeformedVertices out = deform(two_points(), {}, {});
    EXPECT_EQ(out.positions, two_points().positions);
    EXPECT_EQ(out.normals, two_points().normals);
    EXPECT_EQ(out.tangents, two_points().tangents);
}

TEST(Deform, morphTargetsAddUp) {
    Primitive p = two_points();
    p.morph_targets.push_back(
        {.positions = {{2, 0, 0}, {0, 0, 0}}, .normals = {{0, 1, 0}, {0, 0, 0}}, .tangents = {}});
    p.morph_targets.push_back({.positions = {{0, 0, 4}, {1, 1, 1}}, .normals = {}, .tangents = {}});
    const DeformedVertices out = deform(p, {}, std::vector<float>{0.5f, 0.25f});
    expect_near(out.positions[0], {2, 0, 1});
    expect_near(out.positions[1], {0.25f, 1.25f, 0.25f});
    expect_near(out.normals[0], glm::normalize(vec3(1, 0.5f, 0)));
}

TEST(Deform, skinningBlendsJoints) {
    Primitive p = two_points();
    p.joints = {{0, 1, 0, 0}, {1, 0, 0, 0}};
    p.weights = {{0.5f, 0.5f, 0, 0}, {1, 0, 0, 0}};
    const mat4 right = glm::translate(mat4(1), vec3(2, 0, 0));
    const mat4 turned = glm::rotate(mat4(1), pi / 2, vec3(0, 0, 1));
    const DeformedVertices out = deform(p, std::vector<mat4>{right, turned}, {});
    expect_near(out.positions[0], 0.5f * vec3(3, 0, 0) + 0.5f * vec3(0, 1, 0));
    expect_near(out.positions[1], {-1, 0, 0});
    expect_near(out.normals[1], {-1, 0, 0});
    expect_near(vec3(out.tangents[1]), {0, 1, 0});
    EXPECT_EQ(out.tangents[0].w, -1.0f);
}

TEST(Deform, normalsFollowTheInverseTranspose) {
    Primitive p = two_points();
    p.normals = {glm::normalize(vec3(1, 1, 0)), {0, 1, 0}};
    p.joints.assign(2, {0, 0, 0, 0});
    p.weights.assign(2, {1, 0, 0, 0});
    const mat4 stretched = glm::scale(mat4(1), vec3(2, 1, 1));
    expect_near(deform(p, std::vector<mat4>{stretched}, {}).normals[0], glm::normalize(vec3(0.5f, 1, 0)));
    const mat4 mirrored = glm::scale(mat4(1), vec3(-1, 1, 1));
    expect_near(deform(p, std::vector<mat4>{mirrored}, {}).normals[0], glm::normalize(vec3(-1, 1, 0)));
}

}  // namespace
}  // namespace foveray::scene
