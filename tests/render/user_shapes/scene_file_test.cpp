// "shape": "user" in a scene file.
#include <gtest/gtest.h>

#include "render/scene/animator.h"
#include "render/scene/load_scene.h"
#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray::scene {
namespace {

class UserObjects : public testing::Test {
  protected:
    void SetUp() override {
        folder_.write("twist.glsl", "float distance_at(vec3 p, float twist, vec3 size) { return 1.0; }");
    }
    Scene load(const std::string& objects) {
        return load_scene(folder_.write(
            "scene.json", R"({"format":"foveray-scene","version":1,"objects":[)" + objects + "]}"));
    }
    /// One object of twist.glsl with these members besides.
    static std::string object(const std::string& parameters, const std::string& more = "",
                              const std::string& bounds = R"({"min":[-1,-1,-1],"max":[1,2,3]})") {
        return R"({"shape":"user","file":"twist.glsl","parameters":)" + parameters + R"(,"bounds":)" +
               bounds + more + "}";
    }
    void refuse(const std::string& objects, const std::string& part) {
        fakes::expect_fault([&] { load(objects); }, ExitCode::BadInput, part);
    }
    static constexpr const char* good = R"({"twist":2,"size":[3,4,5]})";

    fakes::TemporaryFolder folder_;
};

TEST_F(UserObjects, ShareTheirFile) {
    const Scene scene = load(object(good) + "," + object(R"({"size":[1,1,1],"twist":-1})"));
    ASSERT_EQ(scene.user_shapes.size(), 1u);
    EXPECT_EQ(scene.user_shapes[0].values, (std::vector<UserValue>{{"size", 3}, {"twist", 1}}));
    ASSERT_EQ(scene.shapes.size(), 2u);
    EXPECT_EQ(scene.shapes[0].kind, ShapeKind::User);
    EXPECT_EQ(scene.shapes[0].values, (std::vector<float>{3, 4, 5, 2}));
    EXPECT_EQ(scene.shapes[1].values, (std::vector<float>{1, 1, 1, -1}));
    EXPECT_EQ(bounds_of(scene.shapes[0], scene.shapes[0].values).max, vec3(1, 2, 3));
}

TEST_F(UserObjects, ParametersAreAnimated) {
    const Scene scene =
        load(object(good, R"(,"animation":[{"property":"twist","times":[0,2],"values":[0,10]}])"));
    SceneAnimator animator(scene);
    EXPECT_EQ(animator.advance(1'000'000'000).shapes[0].values, (std::vector<float>{3, 4, 5, 5}));
    refuse(object(good, R"(,"animation":[{"property":"tilt","times":[0],"values":[0]}])"),
           "did you mean \"twist\"");
}

TEST_F(UserObjects, ATimeOfTheirOwnComesLast) {
    folder_.write("twist.glsl", "float distance_at(vec3 p, float time, float twist) { return 1.0; }");
    const Scene scene = load(object(R"({"twist":2,"time":7})") + "," + object(R"({"twist":3})"));
    EXPECT_EQ(scene.shapes[0].values, (std::vector<float>{2, 7}));
    EXPECT_TRUE(scene.shapes[0].user_time);
    EXPECT_EQ(scene.shapes[1].values, (std::vector<float>{3}));
    EXPECT_FALSE(scene.shapes[1].user_time);
}

TEST_F(UserObjects, ParametersThatDoNotFit) {
    refuse(object(R"({"size":[1,2,3]})"),
           "/objects/0/parameters: twist.glsl takes \"twist\", which has no value");
    refuse(object(R"({"size":[1,2,3],"twist":1,"tilt":1})"),
           "/objects/0/parameters/tilt: \"tilt\" is no argument");
    refuse(object(R"({"size":[1,2],"twist":1})"), "/objects/0/parameters/size: \"size\" has 2 numbers");
    refuse(object(R"({"size":[1,2,3],"twist":1e30})"), "/objects/0/parameters/twist: 1e+30 is out of range");
    refuse(object(good) + "," + object(R"({"twist":1})"), "/objects/1/parameters: twist.glsl takes \"size\"");
}

TEST_F(UserObjects, BoundsThatBoundNothing) {
    const auto with_bounds = [](const std::string& bounds) { return object(good, "", bounds); };
    refuse(with_bounds(R"({"min":[-1,0,-1],"max":[1,0,1]})"), "/objects/0/bounds: have no volume");
    refuse(with_bounds(R"({"min":[1,1,1],"max":[-1,-1,-1]})"), "/objects/0/bounds: are the wrong way round");
    refuse(with_bounds(R"({"min":[-1,-1,-1],"max":[1,1e300,1]})"), "/objects/0/bounds");
    refuse(with_bounds(R"({"min":[-1,-1,-1],"max":[1,1e30,1]})"), "/objects/0/bounds: are too large");
    refuse(with_bounds(R"({"min":[-1,-1,-1]})"), "/objects/0/bounds");
    refuse(R"({"shape":"user","file":"twist.glsl","parameters":{"twist":2,"size":[3,4,5]}})",
           "has no \"bounds\"");
    refuse(R"({"shape":"sphere","bounds":{"min":[-1,-1,-1],"max":[1,1,1]}})",
           "/objects/0/bounds: only a user shape");
}

TEST_F(UserObjects, FilesThatAreNone) {
    refuse(R"({"shape":"user","bounds":{"min":[-1,-1,-1],"max":[1,1,1]}})", "has no \"file\"");
    refuse(R"({"shape":"user","file":"none.glsl","bounds":{"min":[-1,-1,-1],"max":[1,1,1]}})", "none.glsl");
}

}  // namespace
}  // namespace foveray::scene
