// Every hit finds its own record: debug hit shaders write out what they were given.
#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "render/engine/table_layout.h"
#include "render/scene/scene_builder.h"
#include "render/user_shapes/compile.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/shapes/ray_rig.h"

namespace foveray::render {
namespace {

using RecordTest = fakes::GpuTest;

/// One voxel, 0.8 m wide.
std::shared_ptr<const scene::Voxels> voxel() {
    scene::Voxels voxels;
    voxels.voxel_size = 0.8f;
    voxels.origin = vec3(-0.4f);
    build_tree({{0, 1.0f, vec3(1.0f), vec3(0, 0, 1)}}, voxels);
    return std::make_shared<scene::Voxels>(std::move(voxels));
}

/// A row of things 2 m apart along x, each met by a ray along -z through the middle of its bounds. Two of
/// each kind.
struct Row {
    scene::SceneBuilder builder;
    std::vector<shared::TestRay> rays;
    int count = 0;
    scene::UserShapeId user = builder.add(
        {scene::parse_user_shape("ball.glsl", "float distance_at(vec3 p) { return length(p) - 0.4; }"), {}});

    vec3 next_place() {
        const vec3 place(2.0f * static_cast<float>(count++), 0.0f, 0.0f);
        shared::TestRay ray{};
        ray.origin = place + vec3(0.013f, 0.007f, 5.0f);
        ray.direction = {0, 0, -1};
        ray.t_max = 100.0f;
        ray.cone = {.width = 1e-3f, .spread = 0.0f};
        rays.push_back(ray);
        return place;
    }

    void add_mesh(scene::Mesh mesh) {
        scene::Node node;
        node.mesh = builder.add(std::move(mesh));
        for (int i = 0; i < 2; ++i) {
            node.local.translation = next_place();
            builder.add(node);
        }
    }

    /// A mesh of two geometries, of which the second stands beside the first.
    void add_mesh_of_two(scene::MaterialId material) {
        scene::Mesh mesh = scene::make_box(vec3(0.4f));
        mesh.primitives.push_back(scene::make_box(vec3(0.4f)).primitives[0]);
        for (vec3& p : mesh.primitives[1].positions) p.x += 2.0f;
        mesh.primitives[1].material = material;
        scene::Node node;
        node.mesh = builder.add(std::move(mesh));
        node.local.translation = next_place();
        next_place();
        builder.add(node);
    }

    void add_shape(const scene::ShapeKindInfo& kind) {
        for (int i = 0; i < 2; ++i) {
            scene::Shape shape;
            shape.kind = kind.kind;
            shape.values = scene::default_values(kind.parameters);
            shape.material = builder.add(scene::Material{});
            if (kind.kind == scene::ShapeKind::Csg) {
                shape.solid.leaves = {{scene::CsgPrimitive::Sphere, glm::scale(mat4(1.0f), vec3(0.4f)), {}}};
                shape.solid.program = {{std::nullopt, 0}};
            }
            if (kind.kind == scene::ShapeKind::Blend) shape.blend_parts.resize(1);
            if (kind.kind == scene::ShapeKind::Voxels) shape.voxels = voxel();
            if (kind.kind == scene::ShapeKind::User) {
                shape.user = user;
                shape.user_bounds = {vec3(-0.4f), vec3(0.4f)};
            }
            scene::Node node;
            if (kind.kind == scene::ShapeKind::Plane) {
                node.local.rotation = glm::angleAxis(pi / 2, vec3(1, 0, 0));
            }
            node.local.translation = next_place();
            rays.back().origin += node.local.rotation * bounds_of(shape, shape.values).center();
            node.shape = builder.add(shape);
            builder.add(node);
        }
    }

    void add_real_surface() {
        scene::RealSurface surface;
        surface.mesh = builder.add(scene::make_box(vec3(0.4f)));
        surface.stage_from_object = glm::translate(mat4(1.0f), next_place());
        builder.add(surface);
    }
};

/// What a record of the table holds.
std::vector<std::uint32_t> words_of(const RayPipeline::Geometry& geometry) {
    return std::visit(
        [](const auto& record) {
            static_assert(sizeof record <= sizeof(shared::RecordSeen::words));
            std::vector<std::uint32_t> words(sizeof record / 4);
            std::memcpy(words.data(), &record, sizeof record);
            return words;
        },
        geometry.record());
}

TEST_F(RecordTest, everyHitIsLedToItsOwnRecord) {
    Row row;
    row.add_mesh(scene::make_sphere(0.4f, 8));
    row.add_mesh_of_two(row.builder.add(scene::Material{}));
    scene::Mesh deformed = scene::make_box(vec3(0.4f));
    deformed.primitives[0].morph_targets.push_back({deformed.primitives[0].positions, {}, {}});
    row.add_mesh(deformed);
    for (const scene::ShapeKindInfo& kind : scene::shape_kinds()) {
        row.add_shape(kind);
    }
    for (int i = 0; i < 2; ++i) row.add_real_surface();
    const scene::Scene scene = std::move(row.builder).build();

    RayRig rig(device(), scene, {user_shapes::compile(scene.user_shapes.at(0))});
    const auto seen = rig.records(row.rays);

    // No two records are alike, so that what is in one tells which it is.
    std::map<std::vector<std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>> places;  // range, geometry
    std::vector<std::uint32_t> counts;
    for (std::uint32_t range = 0; range < rig.table().size(); ++range) {
        counts.push_back(static_cast<std::uint32_t>(rig.table()[range].size()));
        for (std::uint32_t g = 0; g < counts.back(); ++g) {
            const auto at = places.emplace(words_of(rig.table()[range][g]), std::pair(range, g));
            EXPECT_TRUE(at.second) << "range " << range << " geometry " << g;
        }
    }
    const auto offsets = engine::record_offsets(counts, shared::RAY_TYPE_COUNT);

    std::set<std::uint32_t> types, instances, indices;
    for (std::size_t i = 0; i < row.rays.size(); ++i) {
        for (std::uint32_t ray_type = 0; ray_type < shared::RAY_TYPE_COUNT; ++ray_type) {
            const shared::RecordSeen& hit = seen[i * shared::RAY_TYPE_COUNT + ray_type];
            ASSERT_NE(hit.geometry_type, shared::NO_TYPE) << "thing " << i << " is not met";
            EXPECT_EQ(hit.ray_types, 1u << ray_type);
            const GpuInstance& instance = rig.instances()[hit.instance];
            const float x = instance.world_from_object[3].x + 2.0f * static_cast<float>(hit.geometry);
            EXPECT_NEAR(x, 2.0f * static_cast<float>(i), 1e-4f);
            const RayPipeline::Geometry& geometry = rig.table()[instance.structure][hit.geometry];
            SCOPED_TRACE(rig.program().geometry_type_name(geometry.type()));
            EXPECT_EQ(hit.geometry_type, geometry.type());

            std::vector<std::uint32_t> words = words_of(geometry);
            std::memcpy(words.data(), hit.words, 4 * words.size());
            const auto place = places.find(words);
            ASSERT_NE(place, places.end());
            const auto [range, g] = place->second;
            EXPECT_EQ(range, instance.structure);
            EXPECT_EQ(g, hit.geometry);
            types.insert(hit.geometry_type);
            instances.insert(hit.instance);
            indices.insert(shared::hit_record_index(offsets[range], g, ray_type, shared::RAY_TYPE_COUNT));
        }
    }
    EXPECT_EQ(types.size(), 2 + scene::shape_kinds().size());  // triangles and real surfaces
    EXPECT_EQ(types.size(), rig.program().geometry_type_count());
    EXPECT_EQ(instances.size(), row.rays.size() - 1);  // one instance has two geometries
    // Every record was found, by every ray type.
    EXPECT_EQ(indices.size(), shared::RAY_TYPE_COUNT * places.size());
    EXPECT_EQ(*indices.rbegin(), indices.size() - 1);
}

}  // namespace
}  // namespace foveray::render
