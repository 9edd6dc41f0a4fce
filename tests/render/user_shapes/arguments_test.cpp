// What a user's file says of itself, and whether the scene's values fit.
#include <gtest/gtest.h>

#include "render/scene/user_shape.h"
#include "tests/fakes/expect_fault.h"
#include "tests/fakes/temporary_folder.h"

namespace foveray::scene {
namespace {

using Surface = UserShapeCode::Surface;

UserShapeCode parse(const std::string& text) { return parse_user_shape("shape.glsl", text); }

void refuse(const std::string& text, const std::string& part) {
    fakes::expect_fault([&] { parse(text); }, ExitCode::BadInput, part);
}

std::vector<UserValue> values_of(const std::vector<UserShapeCode::Argument>& arguments) {
    std::vector<UserValue> values;
    for (const auto& argument : arguments) values.push_back(argument.value);
    return values;
}

TEST(UserShapeArguments, AreReadFromTheFunctions) {
    const UserShapeCode code = parse(R"(
// float distance_at(vec3 p, float in_a_comment) {
#define TWICE(x) (2.0 * (x))
float helper(float x) { return distance(vec3(x), vec3(0.0)); }
float distance_at(vec3 p, float twist, const in vec3 tint /* not used */, highp vec2 size) { return 1.0; }
vec4 color_at(vec3 p, vec3 n, vec4 paint, float time) { return paint; }
)");
    EXPECT_EQ(code.surface, Surface::Distance);
    EXPECT_EQ(code.line, 5u);
    EXPECT_EQ(values_of(code.arguments), (std::vector<UserValue>{{"twist", 1}, {"tint", 3}, {"size", 2}}));
    ASSERT_TRUE(code.color_arguments);
    EXPECT_EQ(values_of(*code.color_arguments), (std::vector<UserValue>{{"paint", 4}, {"time", 1}}));
    EXPECT_TRUE(code.uses_time());
}

TEST(UserShapeArguments, OfIntersectFollowItsResults) {
    const UserShapeCode code = parse(
        "bool intersect(vec3 o, vec3 d,\n float a, float b, out float t, out vec3 n,\n float radius)\n{ "
        "return false; }");
    EXPECT_EQ(code.surface, Surface::Intersection);
    EXPECT_EQ(values_of(code.arguments), (std::vector<UserValue>{{"radius", 1}}));
    EXPECT_EQ(code.arguments[0].line, 3u);
    EXPECT_FALSE(code.uses_time());
    EXPECT_FALSE(code.color_arguments);
}

TEST(UserShapeArguments, APrototypeIsNoDefinition) {
    EXPECT_EQ(parse("float distance_at(vec3 p);\nfloat distance_at(vec3 p) { return 1.0; }").line, 2u);
    refuse("float distance_at(vec3 p);", "neither distance_at nor intersect");
}

TEST(UserShapeArguments, NothingBeyondTheShaderIsAskedFor) {
    const std::string ball = "float distance_at(vec3 p) { return length(p) - 0.5; }\n";
    refuse(ball + "layout(set = 3, binding = 0) buffer Own { uint count; };",
           "shape.glsl:2: asks for memory");
    refuse(ball + "  # extension GL_ARB_gpu_shader_int64 : require", "shape.glsl:2: asks for an extension");
    EXPECT_NO_THROW(parse(ball + "// layout and #extension are words of a comment"));
}

TEST(UserShapeArguments, FilesThatDefineNoShapeOrTwo) {
    refuse("float far_away(vec3 p) { return 1.0; }", "neither distance_at nor intersect");
    refuse("", "shape.glsl");
    const std::string distance = "float distance_at(vec3 p) { return 1.0; }\n";
    refuse(distance +
               "bool intersect(vec3 o, vec3 d, float a, float b, out float t, out vec3 n) { return false; }",
           "shape.glsl:2: the shape is defined twice");
    refuse(distance + distance, "shape.glsl:2: the shape is defined twice");
}

TEST(UserShapeArguments, WrongSignatures) {
    refuse("\nvec3 distance_at(vec3 p) { return p; }", "shape.glsl:2: distance_at has other arguments");
    refuse("float distance_at(vec2 p) { return 1.0; }", "shape.glsl:1: distance_at has other arguments");
    refuse("float distance_at() { return 1.0; }", "shape.glsl:1: distance_at has other arguments");
    refuse("bool intersect(vec3 o, vec3 d, float a, float b, float t, vec3 n) { return false; }",
           "shape.glsl:1: intersect has other arguments");
    refuse("float distance_at(vec3 p,\n mat3 m) { return 1.0; }", "shape.glsl:2: the argument \"m\"");
    refuse("float distance_at(vec3 p, out float x) { return 1.0; }", "shape.glsl:1: the argument \"x\"");
    refuse("float distance_at(vec3 p, float x[3]) { return 1.0; }", "shape.glsl:1: has an argument");
    refuse("float distance_at(vec3 p, float", "shape.glsl:1: has a list of arguments without an end");
    refuse("/* float distance_at(vec3 p) { return 1.0; }", "neither");
}

TEST(UserShapeArguments, AreMatchedWithValuesByName) {
    const UserShapeCode code =
        parse("float distance_at(vec3 p, float b, vec3 a, float time) { return 1.0; }");
    const auto misfit = [&](const std::vector<UserValue>& given) { return find_misfit(code, given); };
    EXPECT_FALSE(misfit({{"a", 3}, {"b", 1}}));
    EXPECT_FALSE(misfit({{"a", 3}, {"b", 1}, {"time", 1}}));
    ASSERT_TRUE(misfit({{"a", 3}}));
    EXPECT_NE(misfit({{"a", 3}})->what.find("\"b\", which has no value"), std::string::npos);
    EXPECT_EQ(misfit({{"a", 3}, {"b", 1}, {"c", 1}})->value, "c");
    EXPECT_EQ(misfit({{"a", 2}, {"b", 1}})->value, "a");
    EXPECT_EQ(misfit({{"a", 3}, {"b", 1}, {"time", 2}})->value, "time");
}

TEST(UserShapeArguments, HaveRoomForSixteenNumbers) {
    std::string arguments;
    std::vector<UserValue> given;
    for (char name = 'a'; name < 'e'; ++name) {
        arguments += std::string(", vec4 ") + name;
        given.push_back({std::string(1, name), 4});
    }
    EXPECT_FALSE(
        find_misfit(parse("float distance_at(vec3 p" + arguments + ", float time) { return 1.0; }"), given));
    given.push_back({"e", 1});
    const auto misfit =
        find_misfit(parse("float distance_at(vec3 p" + arguments + ", float e) { return 1.0; }"), given);
    ASSERT_TRUE(misfit);
    EXPECT_NE(misfit->remedy.find("16"), std::string::npos);
}

TEST(UserShapeArguments, FilesThatCannotBeRead) {
    const fakes::TemporaryFolder folder;
    const auto refuse_file = [&](const std::filesystem::path& file, const std::string& part) {
        fakes::expect_fault([&] { read_user_shape(file); }, ExitCode::BadInput, part);
    };
    refuse_file(folder / "none.glsl", "none.glsl: cannot be read");
    refuse_file(folder.path(), "cannot be read");
    refuse_file(folder.write("large.glsl", std::string(UserShapeCode::most_bytes + 1, ' ')), "too large");
    refuse_file(folder.write("binary.glsl", std::string("float\0distance_at", 17)), "is no text");
}

}  // namespace
}  // namespace foveray::scene
