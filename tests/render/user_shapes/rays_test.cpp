// Rays find in a user's shape what closed forms and foveray's own sphere say.
#include <random>

#include "render/primary.h"
#include "render/ray_counters.h"
#include "render/user_shapes/compile.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/shapes/ray_rig.h"
#include "tests/render/user_shapes/user_scene.h"

namespace foveray::user_shapes {
namespace {

using UserShapeRays = fakes::GpuTest;

constexpr float radius = 0.8f;

const std::string by_distance = R"(
float distance_at(vec3 p, vec3 center, float radius) { return distance(p, center) - radius; }
)";
const std::string by_intersection = R"(
bool intersect(vec3 origin, vec3 direction, float t_min, float t_max, out float t, out vec3 normal, float radius, vec3 center) {
    float middle = -dot(origin - center, direction);
    vec3 offset = origin - center + middle * direction;
    float half_2 = radius * radius - dot(offset, offset);
    if (half_2 < 0.0) return false;
    t = middle - sqrt(half_2);
    if (t < t_min) t = middle + sqrt(half_2);
    normal = offset + (t - middle) * direction;
    return t >= t_min && t <= t_max;
}
)";
const std::vector<scene::UserValue> parameters = {{"center", 3}, {"radius", 1}};
const std::vector<float> values = {0.1f, 0.0f, -0.1f, radius};

mat4 placed() {
    return glm::translate(mat4(1.0f), vec3(0.3f, -0.2f, 0.5f)) *
           glm::mat4_cast(glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 3)))) *
           glm::scale(mat4(1.0f), vec3(0.5f, 1.5f, 0.8f));
}

std::vector<shared::TestRay> random_rays(std::size_t count) {
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    const auto vector = [&] { return vec3(normal(random), normal(random), normal(random)); };
    std::vector<shared::TestRay> rays(count);
    for (std::size_t i = 0; i < count; ++i) {
        rays[i].origin =
            vec3(0.3f, -0.2f, 0.5f) + (i % 4 == 0 ? 0.1f * vector() : 3.0f * glm::normalize(vector()));
        const vec3 target = vec3(0.3f, -0.2f, 0.5f) + 0.5f * vector();
        rays[i].direction = glm::normalize(i % 4 == 0 ? vector() : target - rays[i].origin);
        rays[i].t_max = 1e6f;
        rays[i].shadow_t_max = 1e6f;
    }
    return rays;
}

scene::Scene builtin_sphere() {
    scene::SceneBuilder builder;
    scene::Shape shape;
    shape.kind = scene::ShapeKind::Sphere;
    shape.values = {radius};
    scene::Node node;
    node.shape = builder.add(std::move(shape));
    node.matrix = placed() * glm::translate(mat4(1.0f), vec3(0.1f, 0.0f, -0.1f));
    builder.add(std::move(node));
    scene::Scene scene = std::move(builder).build();
    scene.materials[0].double_sided = true;
    return scene;
}

TEST_F(UserShapeRays, FindASphereLikeTheBuiltInOne) {
    const auto rays = random_rays(2000);
    const scene::Scene sphere = builtin_sphere();
    const auto expected = render::RayRig(device(), sphere).answers(0, rays);
    for (const std::string& text : {by_distance, by_intersection}) {
        const scene::Scene scene = user_scene(text, parameters, values, {vec3(-1.0f), vec3(1.0f)}, placed());
        render::RayRig rig(device(), scene, {compile(scene.user_shapes[0])});
        const auto found = rig.answers(0, rays);
        int hits = 0, inside = 0, differ = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const shared::Surface &a = expected[i].surface, &b = found[i].surface;
            if (a.kind != b.kind || expected[i].transmittance != found[i].transmittance) {
                ++differ;  // at the rim
                continue;
            }
            if (a.kind == shared::SURFACE_NONE) continue;
            ++hits;
            inside += (a.flags & shared::SURFACE_FLAG_BACK_FACE) != 0;
            const bool grazing = glm::dot(a.geometric_normal, rays[i].direction) > -0.1f;
            EXPECT_NEAR(a.distance, b.distance, grazing ? 5e-3f : 2e-4f);
            EXPECT_EQ(a.flags, b.flags);
            if (!grazing) {
                EXPECT_GT(glm::dot(a.normal, b.normal), 0.999f);
            }
            EXPECT_LE(glm::distance(a.position, b.position), b.position_error + 1e-3f);
        }
        EXPECT_GT(hits, 800);
        EXPECT_GT(inside, 300);
        EXPECT_LE(differ, 8);
    }
}

TEST_F(UserShapeRays, SeeColorsAndTime) {
    scene::Scene scene =
        user_scene(R"(
float distance_at(vec3 p, float grow, float time) { return length(p) - 0.2 - grow * time; }
vec4 color_at(vec3 p, vec3 normal, vec4 paint, vec2 low, float time) {
    return p.y > 0.0 ? paint * normal.z : vec4(low, time, 1.0);
}
)",
                   {{"grow", 1}, {"low", 2}, {"paint", 4}}, {0.1f, 0.25f, 0.5f, 1.0f, 0.75f, 0.5f, 1.0f});
    shared::TestRay up{}, down{};
    up.origin = {0.0f, 0.01f, 3.0f};
    down.origin = {0.0f, -0.01f, 3.0f};
    up.direction = down.direction = {0.0f, 0.0f, -1.0f};
    up.t_max = down.t_max = 10.0f;
    render::RayRig rig(device(), scene, {compile(scene.user_shapes[0])});
    const auto at_start = rig.answers(0, {up, down});
    EXPECT_NEAR(at_start[0].surface.distance, 2.8f, 1e-3f);
    EXPECT_NEAR(at_start[0].surface.base_color.x, 1.0f, 1e-2f);
    EXPECT_NEAR(at_start[0].surface.base_color.y, 0.75f, 1e-2f);
    const auto later = rig.answers(2'000'000'000, {up, down});
    EXPECT_NEAR(later[0].surface.distance, 2.6f, 1e-3f);
    EXPECT_NEAR(later[1].surface.base_color.x, 0.25f, 1e-4f);
    EXPECT_NEAR(later[1].surface.base_color.y, 0.5f, 1e-4f);
    EXPECT_NEAR(later[1].surface.base_color.z, 2.0f, 1e-4f);
}

TEST_F(UserShapeRays, PassThroughTheInnerSideOfSingleSidedMaterials) {
    scene::Scene scene = user_scene(by_intersection, parameters, values);
    scene.materials[0].double_sided = false;
    shared::TestRay ray{};
    ray.origin = {0.1f, 0.0f, -0.1f};
    ray.direction = {0.0f, 0.0f, -1.0f};
    ray.t_max = ray.shadow_t_max = 10.0f;
    render::RayRig rig(device(), scene, {compile(scene.user_shapes[0])});
    const auto answer = rig.answers(0, {ray})[0];
    EXPECT_EQ(answer.surface.kind, shared::SURFACE_NONE);
    EXPECT_EQ(answer.transmittance, vec3(0.0f));
}

/// As a saved change is taken over: the stages keep their references, the scene stays, the pipeline is
/// another.
TEST_F(UserShapeRays, FollowAPipelineThatTakesTheOthersPlace) {
    const auto ball = [](const std::string& color) {
        return "float distance_at(vec3 p) { return length(p) - 0.5; }\nvec4 color_at(vec3 p, vec3 n) { "
               "return vec4(" +
               color + "); }";
    };
    const scene::Scene red = user_scene(ball("1, 0, 0, 1"), {}, {}),
                       green = user_scene(ball("0, 1, 0, 1"), {}, {});
    View view;
    view.size = uvec2(8);
    view.fov = {-0.1f, 0.1f, 0.1f, -0.1f};
    view.stage_from_eye.position = {0.0f, 0.0f, 2.0f};
    auto [params, grid] = render::pixel_grid({&view, 1}, {});
    gpu::Buffer params_buffer(device(), "test grid", sizeof params, gpu::Residence::Upload);
    params_buffer.write(gpu::bytes_of(params));
    grid.grids = params_buffer.address();

    gpu::TextureTable textures(device());
    gpu::FrameRing ring(device(), 1);
    render::RayPipeline pipeline(device(), textures, 1, red, {compile(red.user_shapes[0])});
    scene::SceneAnimator animator(red);
    render::GpuScene gpu_scene(device(), textures, red, 1);
    render::AccelScene accel(device(), gpu_scene, pipeline, 1);
    accel.fill_table(pipeline);
    render::PrimaryStage primary(pipeline.tracer(), pipeline.primary());
    render::RayCounters counters(device(), 1);
    const auto color = [&] {
        const gpu::Commands cmd = ring.begin();
        counters.clear(cmd);
        const render::GpuSceneFrame frame = gpu_scene.record(cmd, 0, animator.advance(0), {});
        accel.record(cmd, 0, frame, pipeline);
        const render::Surfaces hits = primary.record(cmd, grid, 0, counters.address());
        ring.submit();
        ring.wait();
        return shared::surface_of(read_back<shared::StoredSurface>(*hits.buffer, 64)[36]).base_color;
    };
    EXPECT_EQ(color(), vec3(1, 0, 0));
    {
        render::RayPipeline other(device(), textures, 1, red, {compile(green.user_shapes[0])});
        accel.fill_table(other);
        std::swap(pipeline, other);
    }
    EXPECT_EQ(color(), vec3(0, 1, 0));
}

}  // namespace
}  // namespace foveray::user_shapes
