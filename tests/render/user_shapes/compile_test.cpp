#include "render/user_shapes/compile.h"

#include <gtest/gtest.h>

#include "tests/fakes/expect_fault.h"
#include "tests/render/user_shapes/user_scene.h"

namespace foveray::user_shapes {
namespace {

scene::UserShape shape_of(const std::string& text, std::vector<scene::UserValue> values = {}) {
    return {scene::parse_user_shape("folder/shape.glsl", text), std::move(values)};
}

void refuse(const std::string& text, const std::string& part) {
    fakes::expect_fault([&] { compile(shape_of(text)); }, ExitCode::BadInput, part);
    fakes::expect_fault([&] { compile_examination(shape_of(text)); }, ExitCode::BadInput, part);
}

TEST(CompileUserShape, MakesSpirv) {
    const auto shape = shape_of("float distance_at(vec3 p, float time) { return p.x + time; }");
    const render::UserShader shader = compile(shape);
    constexpr std::uint32_t magic = 0x07230203;
    EXPECT_EQ(shader.intersection.at(0), magic);
    EXPECT_EQ(shader.closest_hit.at(0), magic);
    EXPECT_EQ(compile_examination(shape).at(0), magic);
    EXPECT_TRUE(shader.uses_time);
}

TEST(CompileUserShape, ShowsTheUsersFileAndLine) {
    refuse("float distance_at(vec3 p) {\n    return lenght(p);\n}", "folder/shape.glsl:2: 'lenght'");
    refuse("\n\nfloat distance_at(vec3 p) { return 1.0 }", "folder/shape.glsl:3: ");
    refuse("#line 7\nfloat distance_at(vec3 p) { return q; }", "folder/shape.glsl:7: 'q'");
    refuse("float distance_at(vec3 p) { return 1.0; }\n#include \"secrets.txt\"\n", "folder/shape.glsl:2: ");
}

TEST(CompileUserShape, ANameOfFoveraysOwnIsTheUsersError) {
    refuse("float distance_at(vec3 p) { return 1.0; }\nvoid main() {}\n", "folder/shape.glsl");
    fakes::expect_fault([] { compile(shape_of("float distance_at(vec3 p) { return 1.0; }\nint record;")); },
                        ExitCode::BadInput, "folder/shape.glsl:2: 'record'");
}

TEST(CompileUserShape, OtherErrorsHaveTheirOwnRemedy) {
    refuse("float distance_at(vec3 p) { return 1.0; }\n#if 1\n", "folder/shape.glsl: an #if has no #endif");
    refuse("float distance_at(vec3 p) { return p.x > 0.0 ? distance_at(p - 1.0) : 1.0; }",
           "folder/shape.glsl: a function calls itself: ");
    refuse(
        "float b(float x);\nfloat a(float x) { return b(x); }\nfloat b(float x) { return a(x); }\n"
        "float distance_at(vec3 p) { return a(p.x); }",
        "folder/shape.glsl: a function calls itself: ");
    refuse("float distance_at(vec3 p) { return 1.0; }\n#include \"shape.glsl\"\n", "folder/shape.glsl:2: ");
    refuse("float distance_at(vec3 p) { return 1.0; }\n#include \"the user's file\"\n",
           "folder/shape.glsl:2: ");
}

TEST(CompileUserShape, AsksForNothingThatTheDeviceWasNotMadeWith) {
    refuse("float distance_at(vec3 p) { return float(sqrt(double(p.x))); }",
           "folder/shape.glsl: needs numbers of double precision");
    refuse("float distance_at(vec3 p) { dvec3 q = p; return float(dot(q, q)); }", "double precision");
    compile(shape_of("float distance_at(vec3 p) { uint64_t n = 3ul; return p.x * float(n); }"));
}

TEST(CompileUserShape, MayIncludeFoveraysOwn) {
    EXPECT_FALSE(compile(shape_of("#include \"shaders/shared/ray_types.h\"\n"
                                  "float distance_at(vec3 p) { return float(RAY_TYPE_COUNT); }"))
                     .intersection.empty());
}

}  // namespace
}  // namespace foveray::user_shapes
