#include "render/scene/csg.h"
#include "render/scene/load_scene.h"
#include "render/scene/scene_builder.h"
#include "render/scene/singular.h"
#include "tests/fakes/expect_fault.h"
#include "tests/unit/scene/scene_fixture.h"

namespace foveray::scene {
namespace {

Json leaves(std::size_t count) {
    Json list = Json::array();
    for (std::size_t i = 0; i < count; ++i) list.push_back({{"sphere", Json::object()}});
    return list;
}

class SceneObjects : public GltfTest {
  protected:
    Scene load(const Json& object) {
        const Json json = {{"format", "foveray-scene"}, {"version", 1}, {"objects", {object}}};
        return load_scene(folder_.write("scene.json", json.dump()));
    }
    Scene load_solid(const Json& solid) { return load({{"shape", "csg"}, {"solid", solid}}); }
    Scene load_parts(const Json& parts) { return load({{"shape", "blend"}, {"parts", parts}}); }
    void expect_bad(const Json& object, const std::string& part) {
        fakes::expect_fault([&] { load(object); }, ExitCode::BadInput, part);
        fakes::expect_fault([&] { load(object); }, ExitCode::BadInput, "scene.json");
    }
    void expect_bad_parts(const Json& parts, const std::string& part) {
        expect_bad({{"shape", "blend"}, {"parts", parts}}, part);
    }
    void expect_bad_part(const Json& one, const std::string& part) {
        expect_bad_parts(Json::array({one}), part);
    }
    void expect_bad_solid(const Json& solid, const std::string& part) {
        expect_bad({{"shape", "csg"}, {"solid", solid}}, part);
    }
};

TEST_F(SceneObjects, shapesHaveDefaultsAndBounds) {
    const Scene sphere = load({{"shape", "sphere"}});
    EXPECT_EQ(sphere.shapes.at(0).values, std::vector<float>{0.5f});
    expect_near(sphere.bounds.max, vec3(0.5f));
    const Scene turned =
        load({{"shape", "oriented_box"},
              {"parameters", {{"half_size", {1, 0.25, 0.25}}, {"orientation", {0, 0, 1, 1}}}}});
    expect_near(turned.bounds.max, {0.25f, 1.0f, 0.25f});
    const Scene plane = load({{"shape", "plane"}, {"parameters", {{"half_size", {2, 3}}}}});
    EXPECT_FLOAT_EQ(plane.bounds.max.z, 3.0f);
    EXPECT_LT(plane.bounds.max.y, 0.01f);
    EXPECT_GT(plane.bounds.max.y, 0.0f);
}

TEST_F(SceneObjects, whatItsParentsFlattenIsNamed) {
    fakes::GltfBuilder gltf = fakes::GltfBuilder::triangle();
    gltf.json["nodes"][0]["name"] = "lid";
    gltf.json["nodes"][0]["scale"] = {1, 0, 1};
    folder_.write("flat.gltf", gltf.text());
    const auto with = [&](const Json& objects) {
        const Json json = {{"format", "foveray-scene"},
                           {"version", 1},
                           {"models", {{{"file", "flat.gltf"}}}},
                           {"objects", objects}};
        return load_scene(folder_.write("scene.json", json.dump()));
    };
    fakes::expect_fault(
        [&] {
            with({{{"shape", "sphere"}, {"parent", "lid"}}});
        },
        ExitCode::BadInput, "/objects/0/parent: the transform of \"lid\" flattens");
    // Each scale is allowed, their product is not.
    const Json tiny = {{"scale", {1e-12, 1e-12, 1e-12}}};
    fakes::expect_fault(
        [&] {
            with({{{"shape", "sphere"}, {"name", "a"}, {"transform", tiny}},
                  {{"shape", "sphere"}, {"name", "b"}, {"parent", "a"}, {"transform", tiny}}});
        },
        ExitCode::BadInput, "/objects/1/transform: leaves nothing of the object");
}

TEST_F(SceneObjects, whatGrowsFromNothingIsNotFlat) {
    SceneBuilder builder;
    Node parent, child;
    parent.local.scale = {0, 1, 1};
    const NodeId above = builder.add(parent);
    child.parent = above;
    const NodeId below = builder.add(child);
    EXPECT_EQ(flattened_by(builder.so_far(), below), above);
    Animation animation;
    animation.channels.push_back(
        {.node = above, .property = AnimatedProperty::Scale, .times = {0, 1}, .values = {0, 1, 1, 1, 1, 1}});
    builder.add(animation);
    EXPECT_FALSE(flattened_by(builder.so_far(), below).has_value());
}

TEST_F(SceneObjects, filesBelongToUserAndVoxelShapes) {
    expect_bad({{"shape", "sphere"}, {"file", "ball.glsl"}},
               "/objects/0/file: only user and voxels shapes have one");
    expect_bad({{"shape", "blend"}, {"parts", {{{"sphere", Json::object()}}}}, {"file", "a.vox"}},
               "/objects/0/file");
}

TEST_F(SceneObjects, badValuesAreNamed) {
    expect_bad({{"shape", "spere"}}, "did you mean \"sphere\"");
    expect_bad({{"shape", "sphere"}, {"parameters", {{"raduis", 1}}}}, "did you mean \"radius\"");
    expect_bad({{"shape", "sphere"}, {"parameters", {{"radius", 0}}}}, "/objects/0/parameters/radius");
    expect_bad({{"shape", "sphere"}, {"parameters", {{"radius", -1}}}}, "out of range");
    expect_bad({{"shape", "sphere"}, {"parameters", {{"radius", 1e30}}}}, "out of range");
    expect_bad({{"shape", "box"}, {"parameters", {{"half_size", {1, 0, 1}}}}}, "out of range");
    expect_bad({{"shape", "box"}, {"parameters", {{"half_size", {1, 1}}}}}, "has 2 numbers");
    expect_bad({{"shape", "plane"}, {"parameters", {{"half_size", {1e9, 1}}}}}, "out of range");
    expect_bad({{"shape", "plane"}, {"parameters", {{"checker_color", {2, 0, 0}}}}}, "out of range");
    expect_bad({{"shape", "oriented_box"}, {"parameters", {{"orientation", {0, 0, 0, 0}}}}},
               "is no rotation");
    expect_bad({{"shape", "sphere"}, {"transform", {{"scale", {1, 0, 1}}}}}, "/objects/0/transform/scale");
    expect_bad({{"shape", "voxels"}, {"file", "a.vox"}, {"parts", {{{"sphere", Json::object()}}}}},
               "/objects/0/parts: only a blend shape has them");
    expect_bad({{"shape", "sphere"}, {"solid", {{"sphere", Json::object()}}}}, "only a csg shape has one");
}

TEST_F(SceneObjects, transformsThatCannotBeUndoneAreNamed) {
    const auto with = [](const Json& transform) {
        return Json{{"shape", "sphere"}, {"transform", transform}};
    };
    expect_bad(with({{"scale", {0, 1, 1}}}), "/objects/0/transform/scale/0");
    expect_bad(with({{"scale", {1, -1, 1}}}), "/objects/0/transform/scale/1");
    expect_bad(with({{"scale", {1, 1, 1e300}}}), "/objects/0/transform/scale");
    expect_bad(with({{"scale", {1, 1, 1e-30}}}), "/objects/0/transform/scale");
    expect_bad(with({{"rotation", {0, 0, 0, 0}}}), "/objects/0/transform/rotation: is no rotation");
    expect_bad(with({{"translation", {0, 1e300, 0}}}), "/objects/0/transform/translation");
    expect_bad({{"shape", "sphere"}, {"instances", {{{"scale", {1, 1, 0}}}}}},
               "/objects/0/instances/0/scale/2");
    const auto animated = [](const char* property, const Json& value) {
        return Json{{"shape", "sphere"},
                    {"animation", {{{"property", property}, {"times", {0}}, {"values", {value}}}}}};
    };
    expect_bad(animated("scale", {1, 0, 1}), "/objects/0/animation/0/values/0");
    expect_bad(animated("radius", 0), "/objects/0/animation/0/values/0");
    expect_bad(animated("radius", 1e300), "/objects/0/animation/0/values/0");
}

TEST_F(SceneObjects, partsOfBlends) {
    const Scene scene = load_parts({{{"box", {{"half_size", {0.1, 0.2, 0.3}}}}},
                                    {{"torus", Json::object()},
                                     {"operation", "subtract"},
                                     {"transform", {{"translation", {1, 0, 0}}}},
                                     {"color", {1, 0, 0}}},
                                    {{"capsule", {{"radius", 0.1}}}, {"operation", "intersect"}}});
    const std::vector<BlendPart>& parts = scene.shapes.at(0).blend_parts;
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[0].primitive, BlendPrimitive::Box);
    expect_near(parts[0].size, {0.1f, 0.2f, 0.3f});
    EXPECT_EQ(parts[1].operation, BlendOperation::Subtract);
    expect_near(parts[1].size, {0.4f, 0.1f, 0.0f});
    expect_near(parts[1].color, {1, 0, 0});
    EXPECT_EQ(parts[1].object_from_part.translation.x, 1.0f);
    EXPECT_EQ(parts[2].operation, BlendOperation::Intersect);
    expect_near(scene.bounds.max, {0.1f, 0.2f, 0.3f});  // what is taken away adds nothing
}

TEST_F(SceneObjects, boundsHoldWhatFlowsOutOfBlends) {
    // Two in one place join to a surface where a quarter of each's distance along x is 0.1 + 0.25 * 1.
    const Json ball = {{"sphere", {{"radius", 0.1}}}, {"transform", {{"scale", {4, 1, 1}}}}};
    const Scene scene =
        load({{"shape", "blend"}, {"parts", {ball, ball}}, {"parameters", {{"smoothness", 1}}}});
    expect_near(scene.bounds.max, {1.4f, 0.35f, 0.35f});
    expect_near(scene.bounds.min, {-1.4f, -0.35f, -0.35f});
    const Json box = {{"box", {{"half_size", {0.1, 0.1, 0.1}}}}, {"transform", {{"scale", {4, 1, 1}}}}};
    expect_near(
        load({{"shape", "blend"}, {"parts", {box, box}}, {"parameters", {{"smoothness", 1}}}}).bounds.max,
        {0.65f, 0.35f, 0.35f});
}

TEST_F(SceneObjects, badPartsOfBlendsAreNamed) {
    const Json sphere = {{"sphere", Json::object()}};
    expect_bad({{"shape", "blend"}}, "has no \"parts\"");
    expect_bad({{"shape", "sphere"}, {"parts", {sphere}}}, "/objects/0/parts: only a blend shape has them");
    expect_bad_parts(Json::array(), "/objects/0/parts");
    expect_bad_part(Json::object(), "/objects/0/parts/0: is no shape");
    expect_bad_part({{"cone", Json::object()}}, "cone");
    expect_bad_part({{"sphere", Json::object()}, {"box", Json::object()}}, "is several shapes at once");
    expect_bad_parts({sphere, {{"sphere", Json::object()}, {"operation", "divide"}}},
                     "/objects/0/parts/1/operation");
    expect_bad_part({{"sphere", Json::object()}, {"operation", "subtract"}},
                    "/objects/0/parts/0/operation: there is nothing yet to subtract");
    // Parts do not nest.
    expect_bad_part({{"sphere", Json::object()}, {"parts", {sphere}}}, "parts");
    expect_bad_part({{"union", {sphere, sphere}}}, "union");
    EXPECT_NO_THROW(load_parts(leaves(16)));
    expect_bad_parts(leaves(17), "/objects/0/parts");
}

TEST_F(SceneObjects, sizesOfBlendsAreChecked) {
    const auto part = [](const char* kind, const Json& size) { return Json{{kind, size}}; };
    expect_bad_part(part("sphere", {{"radius", 0}}), "/objects/0/parts/0/sphere/radius");
    expect_bad_part(part("sphere", {{"radius", -1}}), "/objects/0/parts/0/sphere/radius");
    expect_bad_part(part("sphere", {{"radius", 1e-9}}), "/objects/0/parts/0: has a size of");
    expect_bad_part(part("sphere", {{"radius", 1e9}}), "/objects/0/parts/0: has a size of");
    expect_bad_part(part("sphere", {{"radius", 1e300}}),
                    "/objects/0/parts/0/sphere/radius: is too large a number");
    expect_bad_part(part("box", {{"half_size", {1, 0, 1}}}), "/objects/0/parts/0/box/half_size/1");
    expect_bad_part(part("box", {{"half_size", {1, 1e300, 1}}}), "/objects/0/parts/0/box/half_size");
    expect_bad_part(part("torus", {{"tube_radius", 0}}), "/objects/0/parts/0/torus/tube_radius");
    expect_bad_part(part("capsule", {{"half_height", 1e9}}), "/objects/0/parts/0: has a size of");
    Json flat = part("sphere", {{"radius", 1}});
    flat["transform"] = {{"scale", {1, 1e-6, 1}}};
    expect_bad_part(flat, "/objects/0/parts/0: has a size of");
    flat["transform"] = {{"scale", {1, 0, 1}}};
    expect_bad_part(flat, "/objects/0/parts/0/transform/scale/1");
    flat["transform"] = {{"translation", {1e9, 0, 0}}};
    expect_bad_part(flat, "/objects/0/parts/0: is too far from the object's origin");
    flat["transform"] = {{"translation", {1e300, 0, 0}}};
    expect_bad_part(flat, "/objects/0/parts/0/transform/translation");
    for (const double smoothness : {-0.1, 1e9, 1e300}) {
        expect_bad({{"shape", "blend"},
                    {"parts", {{{"sphere", Json::object()}}}},
                    {"parameters", {{"smoothness", smoothness}}}},
                   "/objects/0/parameters/smoothness");
    }
}

TEST_F(SceneObjects, cubicCurvesThatSwingOutStayInRange) {
    const auto animated = [](const char* shape, const char* property, double key, double tangent,
                             double end) {
        return Json{{"shape", shape},
                    {"animation",
                     {{{"property", property},
                       {"interpolation", "cubic"},
                       {"times", {0, end}},
                       {"values", {0, key, tangent, tangent, key, 0}}}}}};
    };
    const Scene bulb = load(animated("mandelbulb", "iterations", 6, 1e5, 2));
    SceneAnimator iterations(bulb);
    EXPECT_EQ(iterations.advance(from_seconds(0.5)).shapes[0].values[1], 16.0f);
    EXPECT_EQ(iterations.advance(from_seconds(1.5)).shapes[0].values[1], 1.0f);
    const Scene ball = load(animated("sphere", "radius", 0.3, 1e9, 1e6));
    SceneAnimator radius(ball);
    expect_near(radius.advance(from_seconds(2e5)).shapes[0].bounds.max, vec3(1e4f));
    expect_near(radius.advance(from_seconds(8e5)).shapes[0].bounds.max, vec3(1e-4f));
    expect_bad(animated("sphere", "radius", 0.3, 1e10, 2), "/objects/0/animation/0/values/2");
    expect_bad(animated("sphere", "radius", 0.3, 0, 1e7), "/objects/0/animation/0/times: go beyond");
}

TEST_F(SceneObjects, orientationsAreAnimatedThroughOppositeKeys) {
    const Scene scene = load(
        {{"shape", "oriented_box"},
         {"animation",
          {{{"property", "orientation"}, {"times", {0, 2}}, {"values", {{0, 0, 0, 1}, {0, 0, 0, -1}}}}}}});
    SceneAnimator animator(scene);
    const Aabb bounds = animator.advance(from_seconds(1.0)).shapes[0].bounds;
    expect_near(bounds.max, vec3(0.5f));
}

TEST_F(SceneObjects, solidsBecomeLeavesAndProgram) {
    const Scene scene = load_solid({{"difference",
                                     {{{"sphere", {{"radius", 0.4}}}},
                                      {{"union",
                                        {{{"box", {{"half_size", {0.1, 0.2, 0.3}}}}},
                                         {{"cylinder", {{"radius", 0.1}, {"half_height", 2}}}}}},
                                       {"transform", {{"translation", {1, 0, 0}}}},
                                       {"material", {{"base_color", {1, 0, 0}}}}}}}});
    const CsgSolid& solid = scene.shapes.at(0).solid;
    ASSERT_EQ(solid.leaves.size(), 3u);
    ASSERT_EQ(solid.program.size(), 5u);
    EXPECT_EQ(solid.program[3].operation, CsgOperation::Union);
    EXPECT_EQ(solid.program[4].operation, CsgOperation::Difference);
    EXPECT_FALSE(solid.leaves[0].material);
    ASSERT_TRUE(solid.leaves[1].material && solid.leaves[2].material);
    expect_near(vec3(scene.materials[*solid.leaves[2].material].base_color), {1, 0, 0});
    expect_near(transform(solid.leaves[2].object_from_leaf, {1, 1, 0}), {1.1f, 2.0f, 0.0f});
    expect_near(scene.bounds.max, vec3(0.4f));  // what is taken away adds nothing
}

TEST_F(SceneObjects, boundsOfSolidsFollowTheTree) {
    const Json left = {{"box", Json::object()}};
    const Json right = {{"sphere", Json::object()}, {"transform", {{"translation", {0.75, 0, 0}}}}};
    expect_near(load_solid({{"union", {left, right}}}).bounds.max, {1.25f, 0.5f, 0.5f});
    expect_near(load_solid({{"intersection", {left, right}}}).bounds.min, {0.25f, -0.5f, -0.5f});
    expect_near(load_solid({{"intersection", {left, right}}}).bounds.max, {0.5f, 0.5f, 0.5f});
    const Json turned = {{"cylinder", {{"radius", 0.5}, {"half_height", 1}}},
                         {"transform", {{"euler_degrees", {0, 0, 90}}}}};
    expect_near(load_solid(turned).bounds.max, {1.0f, 0.5f, 0.5f});
}

TEST_F(SceneObjects, badSolidsAreNamed) {
    const Json sphere = {{"sphere", Json::object()}};
    expect_bad({{"shape", "csg"}}, "has no \"solid\"");
    expect_bad_solid(Json::object(), "is no solid");
    expect_bad_solid({{"torus", Json::object()}}, "torus");
    expect_bad_solid({{"union", {sphere}}}, "/objects/0/solid/union");
    expect_bad_solid({{"sphere", Json::object()}, {"box", Json::object()}}, "at once");
    EXPECT_NO_THROW(load_solid({{"union", leaves(16)}}));
    expect_bad_solid({{"union", leaves(17)}}, "more than 16 leaves");
    expect_bad_solid({{"sphere", {{"radius", 0}}}}, "/objects/0/solid/sphere/radius");
    expect_bad_solid({{"sphere", {{"radius", 1e9}}}}, "half-size is 1000000000");
    expect_bad_solid({{"box", Json::object()}, {"transform", {{"scale", {1, 1e-9, 1}}}}}, "half-size");
    expect_bad_solid({{"sphere", Json::object()}, {"transform", {{"translation", {1e9, 0, 0}}}}}, "too far");
    const Json far = {{"sphere", Json::object()}, {"transform", {{"translation", {5, 0, 0}}}}};
    expect_bad_solid({{"intersection", {sphere, far}}}, "nothing is left");
    // Uneven scales round a turn flatten what is inside.
    const Json squeezed = {{"union",
                            {{{"box", {{"half_size", {1, 1, 1}}}},
                              {"transform", {{"euler_degrees", {0, 0, 45}}, {"scale", {1, 1, 1}}}}},
                             sphere}},
                           {"transform", {{"scale", {1000, 1e-3, 1}}}}};
    expect_bad_solid(squeezed, "cannot be undone");
    Json deep = sphere;
    for (int i = 0; i < 5000; ++i) {
        Json list = Json::array();
        list.push_back(std::move(deep));
        list.push_back(sphere);
        deep = Json::object();
        deep["union"] = std::move(list);
    }
    expect_bad_solid(deep, "nested too deeply");
}

}  // namespace
}  // namespace foveray::scene
