// Every hit finds its own record: debug hit shaders write out what they were given.
#include <algorithm>
#include <cstring>
#include <set>

#include "render/scene/scene_builder.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/shapes/ray_rig.h"

namespace foveray::render {
namespace {

using RecordTest = fakes::GpuTest;

/// A row of things 2 m apart along x, each met by a ray along -z at its centre. Two of each kind.
struct Row {
    scene::SceneBuilder builder;
    std::vector<shared::TestRay> rays;
    int count = 0;

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
            scene::Node node;
            if (kind.kind == scene::ShapeKind::Plane) {
                node.local.rotation = glm::angleAxis(pi / 2, vec3(1, 0, 0));
            }
            node.local.translation = next_place();
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

/// Kinds that are nothing but their parameters; the others need data of their own.
bool is_plain(scene::ShapeKind kind) {
    return kind != scene::ShapeKind::User && kind != scene::ShapeKind::Voxels &&
           kind != scene::ShapeKind::Blend;
}

TEST_F(RecordTest, everyHitIsLedToItsOwnRecord) {
    Row row;
    row.add_mesh(scene::make_sphere(0.4f, 8));
    row.add_mesh_of_two(row.builder.add(scene::Material{}));
    scene::Mesh deformed = scene::make_box(vec3(0.4f));
    deformed.primitives[0].morph_targets.push_back({deformed.primitives[0].positions, {}, {}});
    row.add_mesh(deformed);
    for (const scene::ShapeKindInfo& kind : scene::shape_kinds()) {
        if (is_plain(kind.kind)) row.add_shape(kind);
    }
    for (int i = 0; i < 2; ++i) row.add_real_surface();
    const scene::Scene scene = std::move(row.builder).build();

    RayRig rig(device(), scene);
    const auto seen = rig.records(row.rays);
    std::set<std::uint32_t> types, instances;
    for (std::size_t i = 0; i < row.rays.size(); ++i) {
        for (std::uint32_t ray_type = 0; ray_type < shared::RAY_TYPE_COUNT; ++ray_type) {
            const shared::RecordSeen& hit = seen[i * shared::RAY_TYPE_COUNT + ray_type];
            ASSERT_NE(hit.geometry_type, shared::NO_TYPE) << "thing " << i << " is not met";
            EXPECT_EQ(hit.ray_types, 1u << ray_type);
            const GpuInstance& instance = rig.instances()[hit.instance];
            const float x = instance.world_from_object[3].x + 2.0f * static_cast<float>(hit.geometry);
            EXPECT_NEAR(x, 2.0f * static_cast<float>(i), 1e-4f);
            const RayPipeline::Geometry& geometry = rig.table()[instance.structure][hit.geometry];
            EXPECT_EQ(hit.geometry_type, geometry.type())
                << rig.program().geometry_type_name(geometry.type());
            std::visit(
                [&](const auto& record) {
                    static_assert(sizeof record <= sizeof hit.words);
                    EXPECT_EQ(std::memcmp(&record, hit.words, sizeof record), 0)
                        << rig.program().geometry_type_name(geometry.type());
                },
                geometry.record());
            types.insert(hit.geometry_type);
            instances.insert(hit.instance);
        }
    }
    EXPECT_EQ(types.size(), rig.program().geometry_type_count());
    EXPECT_EQ(instances.size(), row.rays.size() - 1);  // one instance has two geometries
}

}  // namespace
}  // namespace foveray::render
