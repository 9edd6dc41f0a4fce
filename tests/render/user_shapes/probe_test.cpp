// What a shape must not do, tried in a child process.
#include "render/user_shapes/probe.h"

#include <gtest/gtest.h>

#include "render/user_shapes/probe_request.h"
#include "tests/fakes/expect_fault.h"
#include "tests/render/user_shapes/user_scene.h"

namespace foveray::user_shapes {
namespace {

ProbeOptions options() {
    ProbeOptions options;
    options.program = FOVERAY_PROGRAM;
    options.validation = true;
    options.start_limit = std::chrono::minutes(2);
    return options;
}

void try_shape(const scene::Scene& scene) { probe(scene, scene.user_shapes[0], 0, options()); }

void refuse(const scene::Scene& scene, const std::string& part) {
    fakes::expect_fault([&] { try_shape(scene); }, ExitCode::BadInput, part);
}

const std::string ray =
    "bool intersect(vec3 o, vec3 d, float t_min, float t_max, out float t, out vec3 n) { ";

TEST(Probe, AcceptsGoodShapes) {
    try_shape(user_scene("float distance_at(vec3 p, float r) { return length(p) - r; }", {{"r", 1}}, {0.8f}));
    // It may touch its bounds.
    try_shape(user_scene("float distance_at(vec3 p, float r) { return length(p) - r; }", {{"r", 1}}, {1.0f}));
    try_shape(user_scene(ray + "t = -o.y / d.y; n = vec3(0, 1, 0); vec3 p = o + t * d; "
                               "return t >= t_min && t <= t_max && max(abs(p.x), abs(p.z)) < 1.0; }",
                         {}, {}, {vec3(-1.0f, -0.1f, -1.0f), vec3(1.0f, 0.1f, 1.0f)}));
}

TEST(Probe, StopsEndlessLoops) {
    refuse(user_scene(
               "float distance_at(vec3 p) {\n float x = 0.5;\n for (;;) {\n  for (int i = 0; i >= 0; i = (i "
               "+ 1) % 9) "
               "{ x = fract(x * 1.37 + p.x); if (x > 2.0) break; }\n  if (x > 2.0) break;\n }\n return x; }",
               {}, {}),
           "shape.glsl:1: distance_at does not finish a small picture within 2 s");
}

TEST(Probe, RefusesNaN) {
    refuse(user_scene("float distance_at(vec3 p) { return sqrt(p.x) - 0.1; }", {}, {}),
           "distance_at returns NaN");
    refuse(user_scene(ray + "t = sqrt(-1.0 - o.x * o.x); n = vec3(0, 1, 0); return true; }", {}, {}),
           "intersect returns NaN");
    refuse(user_scene("float distance_at(vec3 p) { return length(p) - 0.5; }\n"
                      "vec4 color_at(vec3 p, vec3 n) { return vec4(sqrt(-1.0 - p.x * p.x)); }",
                      {}, {}),
           "shape.glsl:2: color_at returns a colour of NaN");
    refuse(user_scene("float distance_at(vec3 p) { return length(p) - 0.5; }\n"
                      "vec4 color_at(vec3 p, vec3 n, float time) { return vec4(time > 0.0 ? sqrt(-1.0 - p.x "
                      "* p.x) : 1.0); }",
                      {}, {}),
           "color_at returns a colour of NaN");
}

TEST(Probe, RefusesSurfacesOutsideTheBounds) {
    const std::string ball = "float distance_at(vec3 p, float r) { return length(p) - r; }";
    refuse(user_scene(ball, {{"r", 1}}, {1.1f}), "distance_at reaches out of its bounds");
    refuse(user_scene("float distance_at(vec3 p) { return length(p - vec3(1.5, 0, 0)) - 0.3; }", {}, {}),
           "reaches out of its bounds, as at (1.");
    refuse(
        user_scene(
            ray +
                "t = 2.0 - o.y; n = vec3(0, 1, 0); t = (1.2 - o.y) / d.y; return t >= t_min && t <= t_max; }",
            {}, {}),
        "intersect reaches out of its bounds");
}

TEST(Probe, RefusesHitsThatTheRayDoesNotHave) {
    refuse(user_scene(ray + "t = t_min - 1.0; n = vec3(0, 1, 0); return true; }", {}, {}),
           "returns a t that is not within t_min and t_max");
    refuse(user_scene(ray + "t = t_min; n = vec3(0); return max(abs(o.x), max(abs(o.y), abs(o.z))) < 1.0; }",
                      {}, {}),
           "returns a normal without length");
}

TEST(Probe, LooksAtAnimatedValuesToo) {
    scene::SceneBuilder builder;
    scene::Shape shape;
    shape.kind = scene::ShapeKind::User;
    shape.user = builder.add(
        {scene::parse_user_shape("shape.glsl",
                                 "float distance_at(vec3 p, float r, float time) { return length(p) - r; }"),
         {{"r", 1}}});
    shape.user_bounds = {vec3(-1.0f), vec3(1.0f)};
    shape.values = {0.5f};
    scene::Node node;
    node.shape = builder.add(std::move(shape));
    scene::Animation animation;
    animation.channels.push_back({.node = builder.add(std::move(node)),
                                  .property = scene::AnimatedProperty::ShapeValues,
                                  .width = 1,
                                  .times = {0.0f, 4.0f},
                                  .values = {0.5f, 2.0f}});
    builder.add(std::move(animation));
    refuse(std::move(builder).build(), "reaches out of its bounds");
}

TEST(Probe, TellsCompileErrors) {
    refuse(user_scene("float distance_at(vec3 p) {\n return q; }", {}, {}), "shape.glsl:2: 'q'");
    // Deeper than a compiler's stack.
    refuse(user_scene("float distance_at(vec3 p) { return " + std::string(100'000, '(') + "p.x" +
                          std::string(100'000, ')') + "; }",
                      {}, {}),
           "shape.glsl:1: ");
}

TEST(Probe, TellsWhatTheChildCannotDo) {
    ProbeOptions other = options();
    const scene::Scene scene = user_scene("float distance_at(vec3 p) { return length(p) - 0.5; }", {}, {});
    other.program = "/bin/false";
    fakes::expect_fault([&] { probe(scene, scene.user_shapes[0], 0, other); }, ExitCode::BadInput,
                        "ends the process");
    other.program = "/bin/none";
    fakes::expect_fault([&] { probe(scene, scene.user_shapes[0], 0, other); }, ExitCode::Missing,
                        "cannot start");
    other = options();
    other.gpu = 99;
    fakes::expect_fault([&] { probe(scene, scene.user_shapes[0], 0, other); }, ExitCode::BadInput, "99");
}

TEST(Probe, RequestsGoThroughJson) {
    const scene::Scene scene = user_scene(
        "float distance_at(vec3 p, float r, float time) { return length(p) - r; }", {{"r", 1}}, {0.5f});
    const ProbeRequest request = make_request(scene, scene.user_shapes[0], 0);
    EXPECT_EQ(request.moments.size(), 8u);  // time goes on
    EXPECT_EQ(to_json(from_json(to_json(request))), to_json(request));
}

}  // namespace
}  // namespace foveray::user_shapes
