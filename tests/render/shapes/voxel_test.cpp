// Voxel objects on the GPU: rays against a list of cubes, the level that a cone ends at, and what far objects
// look like.
#include <cmath>

#include "render/scene/scene_builder.h"
#include "render/scene/voxelize.h"
#include "shaders/shared/voxels.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/fakes/random.h"
#include "tests/render/geometry/scene_rig.h"
#include "tests/render/shapes/ray_rig.h"

namespace foveray::render {
namespace {

using scene::Voxels;
using scene::VoxelSample;

Voxels tree_of(std::vector<VoxelSample> samples, float size, vec3 origin, bool show_faces) {
    Voxels voxels;
    voxels.voxel_size = size;
    voxels.origin = origin;
    voxels.show_faces = show_faces;
    EXPECT_TRUE(build_tree(std::move(samples), voxels));
    return voxels;
}

scene::Scene scene_with(std::shared_ptr<const Voxels> voxels, const mat4& world_from_object,
                        bool unlit = false) {
    scene::SceneBuilder builder;
    scene::Shape shape;
    shape.kind = scene::ShapeKind::Voxels;
    shape.voxels = std::move(voxels);
    scene::Material material;
    material.double_sided = true;
    material.unlit = unlit;
    shape.material = builder.add(material);
    scene::Node node;
    node.shape = builder.add(std::move(shape));
    node.matrix = world_from_object;
    builder.add(node);
    return std::move(builder).build();
}

struct Hit {
    float t = 1e30f;
    vec3 face{0.0f};
    std::size_t voxel = 0;
};

/// The nearest cube that does not hold the origin; object space.
Hit nearest_cube(const Voxels& v, const std::vector<VoxelSample>& samples, vec3 origin, vec3 direction) {
    Hit hit;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const vec3 low = v.origin + v.voxel_size * vec3(scene::place_of(samples[i].morton));
        const vec3 a = (low - origin) / direction, b = (low + v.voxel_size - origin) / direction;
        const vec3 in = glm::min(a, b), out = glm::max(a, b);
        const float t = std::max({in.x, in.y, in.z}), end = std::min({out.x, out.y, out.z});
        if (t >= end || t <= 0.0f || t >= hit.t) continue;
        hit = {t, vec3(0.0f), i};
        const int axis = in.x == t ? 0 : in.y == t ? 1 : 2;
        hit.face[axis] = direction[axis] > 0.0f ? -1.0f : 1.0f;
    }
    return hit;
}

class VoxelTest : public fakes::GpuTest {};

TEST_F(VoxelTest, agreesWithAListOfCubes) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        fakes::Random random(seed);
        const bool faces = seed != 2u;
        const std::uint32_t side = seed == 3u ? 7 : 20;
        std::vector<VoxelSample> samples;
        for (int i = 0; i < 150; ++i) {
            const glm::uvec3 place(random.below(side), random.below(side), random.below(side));
            samples.push_back({scene::morton_of(place), 1.0f, random.vector(0.1f, 1.0f),
                               glm::normalize(random.vector(-1.0f, 1.0f))});
        }
        merge_samples(samples);
        const auto voxels = std::make_shared<Voxels>(tree_of(samples, 0.07f, {-0.7f, -0.6f, -0.8f}, faces));
        const mat4 world = glm::translate(mat4(1.0f), random.vector(-2.0f, 2.0f)) *
                           glm::mat4_cast(random.rotation()) *
                           glm::scale(mat4(1.0f), random.vector(0.5f, 2.0f));
        const mat4 object = glm::inverse(world);
        const scene::Scene scene = scene_with(voxels, world);
        RayRig rig(device(), scene);
        std::vector<shared::TestRay> rays;
        for (int i = 0; i < 5000; ++i) {
            shared::TestRay ray{};
            const vec3 target = vec3(world * vec4(random.vector(-0.8f, 0.8f), 1.0f));
            const float far = i % 3 == 0 ? 0.8f : 4.0f;
            ray.origin = vec3(world * vec4(random.vector(-far, far), 1.0f));
            ray.direction = glm::normalize(target - ray.origin);
            ray.t_max = ray.shadow_t_max = 100.0f;
            rays.push_back(ray);
        }
        const auto answers = rig.answers(0, rays);
        int hits = 0, differing = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const vec3 origin = vec3(object * vec4(rays[i].origin, 1.0f));
            const vec3 direction = mat3(object) * rays[i].direction;
            const Hit expected = nearest_cube(*voxels, samples, origin, direction);
            const shared::Surface& s = answers[i].surface;
            const bool hit = s.kind == shared::SURFACE_VIRTUAL;
            hits += hit;
            EXPECT_EQ(hit, answers[i].transmittance == vec3(0.0f));
            if (hit != (expected.t < 1e29f) || (hit && std::abs(s.distance - expected.t) > 1e-3f)) {
                ++differing;  // along an edge
                continue;
            }
            if (!hit) continue;
            EXPECT_EQ(s.alpha, 1.0f);
            EXPECT_LT(glm::length(s.base_color - samples[expected.voxel].color), 0.03f);
            if (!faces) continue;
            const vec3 normal = glm::normalize(glm::transpose(mat3(object)) * expected.face);
            EXPECT_GT(glm::dot(s.normal, normal), 0.98f) << i;
        }
        EXPECT_GT(hits, 400);
        EXPECT_LE(differing, 10);
    }
}

TEST_F(VoxelTest, smoothVoxelsAreShadedByTheNormalThatTheyHold) {
    const vec3 normal = glm::normalize(vec3(0.2f, 0.4f, 1.0f));
    const std::vector<VoxelSample> samples = {{0, 1.0f, vec3(1.0f), normal}};
    const auto voxels = std::make_shared<Voxels>(tree_of(samples, 1.0f, vec3(-0.5f), false));
    const quat turn = glm::normalize(quat(0.9f, 0.1f, 0.3f, 0.0f));
    const scene::Scene scene = scene_with(voxels, glm::mat4_cast(turn));
    RayRig rig(device(), scene);
    shared::TestRay ray{};
    ray.origin = turn * vec3(0, 0, 5);
    ray.direction = turn * vec3(0, 0, -1);
    ray.t_max = ray.shadow_t_max = 100.0f;
    shared::TestRay behind = ray;
    behind.origin = -ray.origin, behind.direction = -ray.direction;
    const auto answers = rig.answers(0, {ray, behind});
    EXPECT_NEAR(answers[0].surface.distance, 4.5f, 1e-4f);
    EXPECT_GT(glm::dot(answers[0].surface.normal, turn * normal), 0.9999f);
    EXPECT_EQ(answers[0].surface.flags & shared::SURFACE_FLAG_BACK_FACE, 0u);
    EXPECT_GT(glm::dot(answers[1].surface.normal, turn * -normal), 0.9999f);
    EXPECT_NE(answers[1].surface.flags & shared::SURFACE_FLAG_BACK_FACE, 0u);
}

/// A slab one voxel thick that fills a square of the xy plane.
std::vector<VoxelSample> slab(std::uint32_t side) {
    std::vector<VoxelSample> samples;
    for (std::uint32_t x = 0; x < side; ++x) {
        for (std::uint32_t y = 0; y < side; ++y) {
            samples.push_back({scene::morton_of({x, y, side / 2}), 1.0f, vec3(1.0f), vec3(0, 0, 1)});
        }
    }
    return samples;
}

TEST_F(VoxelTest, theLevelFollowsTheCone) {
    constexpr std::uint32_t side = 1024;
    Voxels tree = tree_of(slab(side), 1.0f / side, vec3(-0.5f), false);
    // Each level gets its own colour.
    for (std::uint32_t level = 0; level <= tree.depth; ++level) {
        const std::uint32_t d = tree.depth - level;
        for (std::uint32_t i = tree.level_begin[d]; i < tree.level_begin[d + 1]; ++i) {
            tree.nodes[i].x = (tree.nodes[i].x & 0xFF000000u) | 25 * level;
        }
    }
    const float scale = 3.0f;  // voxels are scale / side metres wide
    const scene::Scene scene =
        scene_with(std::make_shared<Voxels>(tree), glm::scale(mat4(1.0f), vec3(scale)));
    RayRig rig(device(), scene);
    std::vector<shared::TestRay> rays;
    for (float width = 0.25f; width < 512.0f; width *= 1.19f) {
        for (const bool spreads : {false, true}) {
            shared::TestRay ray{};
            ray.origin = {0.1f, 0.2f, 10.0f};
            ray.direction = {0, 0, -1};
            ray.t_max = ray.shadow_t_max = 100.0f;
            const float metres = width * scale / side;
            ray.cone = spreads ? shared::RayCone{0.0f, metres / 10.0f} : shared::RayCone{metres, 0.0f};
            rays.push_back(ray);
        }
    }
    const auto answers = rig.answers(0, rays);
    const float deepest = static_cast<float>(tree.depth - shared::VOXEL_LEAST_DEPTH);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const float width =
            ray_cone_width(rays[i].cone, answers[i].surface.distance) * static_cast<float>(side) / scale;
        const float level = 255.0f * std::sqrt(answers[i].surface.base_color.r) / 25.0f;
        const float exact = std::log2(width * shared::VOXEL_CONE_PART);
        if (std::abs(exact - std::round(exact)) < 0.03f) continue;
        EXPECT_NEAR(level, glm::clamp(std::floor(exact), 0.0f, deepest), 0.05f) << "width " << width;
        EXPECT_EQ(answers[i].surface.alpha, 1.0f);
        EXPECT_EQ(answers[i].transmittance, vec3(0.0f));
    }
}

/// Walls whose two sides are in one node, as .vox files have them: what is open on both sides has no normal.
TEST_F(VoxelTest, coarseRaysMeetTheFacesOfThinWalls) {
    constexpr std::uint32_t side = 512;
    for (const std::uint32_t thickness : {1u, 2u}) {
        std::vector<VoxelSample> samples;
        for (std::uint32_t i = 0; i < side * side; ++i) {
            for (std::uint32_t z = 0; z < thickness; ++z) {
                const float open = thickness == 1 ? 0.0f : z == 0 ? -1.0f : 1.0f;
                samples.push_back({scene::morton_of({i % side, i / side, side / 2 + z}), 1.0f, vec3(1.0f),
                                   vec3(0, 0, open)});
            }
        }
        const auto voxels =
            std::make_shared<Voxels>(tree_of(std::move(samples), 1.0f / side, vec3(-0.5f), true));
        const scene::Scene scene = scene_with(voxels, mat4(1.0f));
        RayRig rig(device(), scene);
        fakes::Random random(5);
        std::vector<shared::TestRay> rays(200);
        for (shared::TestRay& ray : rays) {
            const vec3 target = random.vector(-0.2f, 0.2f);
            ray.origin = vec3(random.in(-2, 2), random.in(-2, 2), random.below(2) == 0 ? -2.0f : 2.0f);
            ray.direction = glm::normalize(vec3(target.x, target.y, 0.0f) - ray.origin);
            ray.t_max = ray.shadow_t_max = 100.0f;
            ray.cone = {.width = 20.0f / side, .spread = 0.0f};
        }
        const auto answers = rig.answers(0, rays);
        int other = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(answers[i].surface.kind, shared::SURFACE_VIRTUAL);
            EXPECT_EQ(answers[i].surface.flags & shared::SURFACE_FLAG_BACK_FACE, 0u);
            other += answers[i].surface.normal.z * glm::sign(rays[i].origin.z) < 0.95f;
        }
        EXPECT_LE(other, 4) << "of walls " << thickness << " thick";
    }
}

/// Mean radiance and coverage of an unlit object seen in `size` x `size` pixels, each the mean of `fine`
/// squared.
vec4 mean_seen(const gpu::Device& device, const std::shared_ptr<const Voxels>& voxels, const quat& turn,
               std::uint32_t size, std::uint32_t shifts) {
    const scene::Aabb bounds = voxels->bounds();
    const float width = glm::length(bounds.extent());
    const mat4 world = glm::translate(mat4(1.0f), vec3(0, 0, -10)) * glm::mat4_cast(turn) *
                       glm::scale(mat4(1.0f), vec3(2.0f / width)) *
                       glm::translate(mat4(1.0f), -bounds.center());
    const scene::Scene scene = scene_with(voxels, world, true);
    SceneRig rig(device, scene);
    const float half_angle = std::atan(0.11f);
    View view = view_forward(degrees(half_angle), uvec2(size));
    // Pixels at all places relative to the object, as if it moved by less than a pixel.
    vec4 mean(0.0f);
    for (std::uint32_t i = 0; i < shifts * shifts; ++i) {
        const vec2 shift = (vec2(i % shifts, i / shifts) + 0.5f) / static_cast<float>(shifts) - 0.5f;
        const vec2 angle = shift * 2.0f * half_angle / static_cast<float>(size);
        view.stage_from_eye.orientation =
            glm::angleAxis(angle.x, vec3(0, 1, 0)) * glm::angleAxis(angle.y, vec3(1, 0, 0));
        for (const vec4& pixel : rig.picture(0, view, Settings{})) mean += pixel;
    }
    mean /= static_cast<float>(shifts * shifts * size * size);
    return mean;
}

struct Looks {
    const char* name;
    std::shared_ptr<const Voxels> voxels;
    float covers_alike = 0.02f;  // how far off what it covers may be
};

scene::Scene mesh_scene(scene::Mesh mesh, vec3 scale, vec3 color) {
    scene::SceneBuilder builder;
    scene::Material material;
    material.base_color = vec4(color, 1.0f);
    material.double_sided = true;
    mesh.primitives[0].material = builder.add(material);
    // Colours that change over the surface.
    for (const vec3& p : mesh.primitives[0].positions) {
        mesh.primitives[0].colors.push_back(
            vec4(glm::mix(vec3(1, 0.2f, 0.1f), vec3(0.1f, 0.5f, 1), p.x + 0.5f), 1.0f));
    }
    scene::Node node;
    node.mesh = builder.add(std::move(mesh));
    node.local.scale = scale;
    builder.add(node);
    return std::move(builder).build();
}

Looks looks(const char* name, const scene::Mesh& mesh, vec3 scale, float gray, std::uint32_t resolution) {
    return {name, std::make_shared<const Voxels>(*voxelize(mesh_scene(mesh, scale, vec3(gray)), resolution))};
}

/// In a quarter as many pixels and fewer, on the average over where they fall: the mean colour within 2 %,
/// the part of the picture that it covers too unless said otherwise.
void expect_same_mean(const gpu::Device& device, const Looks& object, int turns) {
    fakes::Random random(7);
    for (int i = 0; i < turns; ++i) {
        const quat turn = i == 0 ? glm::angleAxis(0.1f, vec3(0.8f, 0.6f, 0)) : random.rotation();
        const vec4 full = mean_seen(device, object.voxels, turn, 400, 1);
        for (const std::uint32_t size : {20u, 40u, 80u}) {
            const vec4 far = mean_seen(device, object.voxels, turn, size, 400 / size);
            const vec3 color = vec3(far) / far.a, full_color = vec3(full) / full.a;
            EXPECT_LT(glm::length(color - full_color) / glm::length(full_color), 0.02f)
                << object.name << " turned " << i << " in " << size << " pixels";
            EXPECT_NEAR(far.a / full.a, 1.0f, object.covers_alike)
                << object.name << " turned " << i << " in " << size << " pixels";
        }
    }
}

TEST_F(VoxelTest, aFarObjectLooksOnAverageAsItDoesInFull) {
    Looks rod = looks("rod", scene::make_box(vec3(0.5f)), {1.0f, 0.04f, 0.04f}, 0.8f, 256);
    rod.covers_alike = 0.05f;  // ten voxels thick
    for (const Looks& object :
         {looks("ball", scene::make_sphere(0.5f, 64), vec3(1.0f), 0.9f, 256),
          looks("box", scene::make_box(vec3(0.5f)), {1.0f, 0.6f, 0.3f}, 0.7f, 256),
          looks("sheet", scene::make_rectangle(vec2(0.5f)), vec3(1.0f), 0.8f, 256), rod}) {
        expect_same_mean(device(), object, 4);
    }
}

/// The level at which a ray through a pixel ends, of `size` across the view of mean_seen, 10 m away.
std::uint32_t level_seen(const Voxels& voxels, std::uint32_t size) {
    const float pixel = 2.0f * 0.11f * 10.0f / static_cast<float>(size);
    const float voxel = voxels.voxel_size * 2.0f / glm::length(voxels.bounds().extent());
    const float level = std::log2(std::max(shared::VOXEL_CONE_PART * pixel / voxel, 1.0f));
    return std::min(static_cast<std::uint32_t>(level), voxels.depth - shared::VOXEL_LEAST_DEPTH);
}

TEST_F(VoxelTest, soItDoesAtLevelsFarAboveItsVoxels) {
    const Looks ball = looks("fine ball", scene::make_sphere(0.5f, 64), vec3(1.0f), 0.9f, 512);
    const Looks rod = looks("fine rod", scene::make_box(vec3(0.5f)), {1.0f, 0.04f, 0.04f}, 0.8f, 1024);
    const auto levels = [](const Looks& object) {
        std::vector<std::uint32_t> result;
        for (const std::uint32_t size : {400u, 80u, 40u, 20u})
            result.push_back(level_seen(*object.voxels, size));
        return result;
    };
    ASSERT_EQ(levels(ball), (std::vector<std::uint32_t>{0, 1, 2, 2}));
    ASSERT_EQ(levels(rod), (std::vector<std::uint32_t>{0, 1, 2, 3}));
    expect_same_mean(device(), ball, 2);
    expect_same_mean(device(), rod, 3);
}

TEST_F(VoxelTest, coarserRaysWalkLess) {
    const Looks ball = looks("ball", scene::make_sphere(0.5f, 64), vec3(1.0f), 0.9f, 1024);
    const scene::Scene scene = scene_with(ball.voxels, mat4(1.0f));
    RayRig rig(device(), scene);
    const auto mean_steps = [&](float cone_voxels) {
        fakes::Random random(3);
        std::vector<shared::TestRay> rays(400);
        for (shared::TestRay& ray : rays) {
            ray.origin = 3.0f * random.direction();
            ray.direction = glm::normalize(0.5f * random.direction() - ray.origin);
            ray.t_max = ray.shadow_t_max = 100.0f;
            ray.cone = {cone_voxels * ball.voxels->voxel_size, 0.0f};
        }
        double sum = 0.0;
        for (const std::uint32_t steps : rig.steps(rays)) sum += steps;
        return sum / static_cast<double>(rays.size());
    };
    // Down to single voxels, and to nodes 1, 2 and 3 levels above them: most of the way is through empty
    // space, which all rays cross in cubes as large as may be.
    std::vector<double> steps;
    for (const float width : {0.0f, 10.0f, 20.0f, 40.0f}) steps.push_back(mean_steps(width));
    EXPECT_GT(steps[0], 20.0);
    for (std::size_t level = 1; level < steps.size(); ++level)
        EXPECT_LT(steps[level], steps[level - 1]) << level;
    EXPECT_LT(steps[3], 0.9 * steps[0]);
}

}  // namespace
}  // namespace foveray::render
