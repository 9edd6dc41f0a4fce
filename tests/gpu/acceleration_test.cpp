#include "render/gpu/acceleration.h"

#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/gpu/probe.h"

namespace foveray::gpu {
namespace {

using shared::ProbeHit;
using shared::ProbeRay;

class AccelerationTest : public fakes::GpuTest {
  protected:
    Probe probe_{device()};
};

TEST_F(AccelerationTest, RaysMeetTrianglesWhereTheyAre) {
    const Triangles near(device(), corner_triangle(0, 0, -1)), far(device(), corner_triangle(2, 0, -7.5f));
    const BottomLevel level = build_bottom_level(device(), {near.geometry(), far.geometry()});
    const auto hits =
        probe_.trace(level, 2, {ray_at(0.25f, 0.25f), ray_at(2.25f, 0.25f), ray_at(0.9f, 0.9f)});
    EXPECT_FLOAT_EQ(hits[0].distance, 2.0f);
    EXPECT_EQ(hits[0].geometry, 0u);
    EXPECT_FLOAT_EQ(hits[1].distance, 8.5f);
    EXPECT_EQ(hits[1].geometry, 1u);
    EXPECT_EQ(hits[2].shader, shared::PROBE_MISS);
}

TEST_F(AccelerationTest, RaysAreCutToTheirRange) {
    const Triangles mesh(device(), corner_triangle(0, 0, -1));
    const BottomLevel level = build_bottom_level(device(), {mesh.geometry()});
    ProbeRay short_ray = ray_at(0.25f, 0.25f), late_ray = short_ray;
    short_ray.t_max = 1.9f;
    late_ray.t_min = 2.1f;
    for (const ProbeHit& hit : probe_.trace(level, 1, {short_ray, late_ray}))
        EXPECT_EQ(hit.shader, shared::PROBE_MISS);
}

TEST_F(AccelerationTest, InstancesArePlacedByTheirTransform) {
    const Triangles mesh(device(), corner_triangle(0, 0, 0));
    const BottomLevel level = build_bottom_level(device(), {mesh.geometry()});
    // Turned by 90° round z, so that it covers -1…0 in x, stretched by 3 in y, then moved.
    glm::mat4 transform = glm::translate(glm::mat4(1.0f), {5.0f, 0.0f, -4.0f});
    transform = glm::scale(transform, {1.0f, 3.0f, 1.0f});
    transform = glm::rotate(transform, 1.57079633f, glm::vec3(0.0f, 0.0f, 1.0f));
    probe_.tracer.set_table({{ProbeProgram::geometry(probe_.narrow, {1})}});
    const auto hits =
        probe_.trace({{.world_from_object = glm::mat4x3(transform), .bottom_level = level.address()}},
                     {ray_at(4.9f, 2.5f), ray_at(4.1f, 0.1f), ray_at(5.1f, 0.1f), ray_at(4.1f, 2.5f)});
    EXPECT_FLOAT_EQ(hits[0].distance, 5.0f);
    EXPECT_FLOAT_EQ(hits[1].distance, 5.0f);
    EXPECT_EQ(hits[2].shader, shared::PROBE_MISS);
    EXPECT_EQ(hits[3].shader, shared::PROBE_MISS);
}

TEST_F(AccelerationTest, CompactedStructuresAreNoLargerAndStillHit) {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 2000; ++i) {
        const auto triangle = corner_triangle(static_cast<float>(i % 50), static_cast<float>(i / 50), -1.0f);
        corners.insert(corners.end(), triangle.begin(), triangle.end());
    }
    const Triangles mesh(device(), corners);
    const BottomLevel level = build_bottom_level(device(), {mesh.geometry()});

    const vk::AccelerationStructureGeometryTrianglesDataKHR triangles(
        vk::Format::eR32G32B32Sfloat, vk::DeviceOrHostAddressConstKHR(mesh.positions.address()), 12, 5999,
        vk::IndexType::eUint32, vk::DeviceOrHostAddressConstKHR(mesh.indices.address()));
    const vk::AccelerationStructureGeometryKHR geometry(vk::GeometryTypeKHR::eTriangles, triangles);
    using Flag = vk::BuildAccelerationStructureFlagBitsKHR;
    vk::AccelerationStructureBuildGeometryInfoKHR info(vk::AccelerationStructureTypeKHR::eBottomLevel,
                                                       Flag::ePreferFastTrace | Flag::eAllowCompaction);
    info.setGeometries(geometry);
    const auto sizes = device().vk().getAccelerationStructureBuildSizesKHR(
        vk::AccelerationStructureBuildTypeKHR::eDevice, info, 2000u);
    EXPECT_LE(level.size(), sizes.accelerationStructureSize);
    if (device().physical().getProperties().deviceType != vk::PhysicalDeviceType::eCpu) {
        EXPECT_LT(level.size(), sizes.accelerationStructureSize);  // lavapipe's are as large as before
    }

    const auto hits =
        probe_.trace(level, 1, {ray_at(0.25f, 0.25f), ray_at(49.25f, 39.25f), ray_at(17.25f, 3.25f)});
    EXPECT_EQ(hits[0].primitive, 0u);
    EXPECT_EQ(hits[1].primitive, 1999u);
    EXPECT_EQ(hits[2].primitive, 167u);
}

TEST_F(AccelerationTest, SmallBatchesGiveTheSameStructures) {
    std::vector<Triangles> meshes;
    std::vector<BottomLevelInfo> infos;
    for (int i = 0; i < 9; ++i) {
        meshes.emplace_back(device(),
                            corner_triangle(static_cast<float>(2 * i), 0, -1.0f - static_cast<float>(i)));
        infos.push_back({"mesh " + std::to_string(i), {meshes.back().geometry()}, i % 3 == 0});
    }
    std::vector<ProbeRay> rays;
    for (int i = 0; i < 9; ++i) rays.push_back(ray_at(static_cast<float>(2 * i) + 0.25f, 0.25f));
    probe_.tracer.set_table({{ProbeProgram::geometry(probe_.narrow, {1})}});
    for (const vk::DeviceSize limit : {vk::DeviceSize{1}, vk::DeviceSize{4096}, vk::DeviceSize{256} << 20}) {
        const auto levels = build_bottom_levels(device(), infos, limit);
        ASSERT_EQ(levels.size(), 9u);
        std::vector<TopLevelInstance> instances;
        for (const BottomLevel& level : levels) instances.push_back({.bottom_level = level.address()});
        const auto hits = probe_.trace(instances, rays);
        for (std::uint32_t i = 0; i < 9; ++i) {
            EXPECT_EQ(levels[i].deforms(), i % 3 == 0);
            EXPECT_EQ(hits[i].instance, i);
            EXPECT_FLOAT_EQ(hits[i].distance, 2.0f + static_cast<float>(i));
        }
    }
}

TEST_F(AccelerationTest, RefittingAndRebuildingMoveTheHit) {
    const Triangles start(device(), corner_triangle(0, 0, -1));
    BottomLevel level = build_bottom_level(device(), {start.geometry()}, true);
    EXPECT_FLOAT_EQ(probe_.trace(level, 1, {ray_at(0.25f, 0.25f)})[0].distance, 2.0f);
    for (const bool refit : {true, false, true}) {
        const float z = refit ? -3.0f : -6.0f;
        const Triangles moved(device(), corner_triangle(4, 4, z));
        const std::vector<AccelerationGeometry> geometries = {moved.geometry()};
        const BottomLevelUpdate update{&level, geometries, refit};
        submit_and_wait(device(),
                        [&](const Commands& cmd) { update_bottom_levels(cmd, std::span(&update, 1)); });
        const auto hits = probe_.trace(level, 1, {ray_at(0.25f, 0.25f), ray_at(4.25f, 4.25f)});
        EXPECT_EQ(hits[0].shader, shared::PROBE_MISS);
        EXPECT_FLOAT_EQ(hits[1].distance, 1.0f - z);
    }
}

TEST_F(AccelerationTest, UpdatesBetweenTracesOfOneFrameAreOrdered) {
    Probe probe(device(), 2);
    const Triangles first(device(), corner_triangle(0, 0, -1)), then(device(), corner_triangle(0, 0, -9));
    BottomLevel level = build_bottom_level(device(), {first.geometry()}, true);
    const std::vector<AccelerationGeometry> geometries = {then.geometry()};
    const BottomLevelUpdate update{&level, geometries, true};
    const std::vector<ProbeRay> rays(64, ray_at(0.25f, 0.25f));
    Uploader uploader(device());
    const Buffer input = uploader.buffer("rays", range_bytes(rays));
    uploader.flush();
    const Buffer before(device(), "hits before", rays.size() * sizeof(ProbeHit), Residence::Device);
    const Buffer after(device(), "hits after", rays.size() * sizeof(ProbeHit), Residence::Device);
    probe.tracer.set_table({{ProbeProgram::geometry(probe.narrow, {1})}});
    const std::vector<TopLevelInstance> instances = {{.bottom_level = level.address()}};
    submit_and_wait(device(), [&](const Commands& cmd) {
        const auto trace_into = [&](std::uint32_t slot, const Buffer& hits) {
            probe.scene.build(cmd, slot, instances);
            probe.tracer.prepare(cmd, slot, probe.scene);
            probe.tracer.trace(cmd, probe.probe, shared::ProbePush{input.address(), hits.address()},
                               {64, 1, 1});
        };
        trace_into(0, before);
        update_bottom_levels(cmd, std::span(&update, 1));
        trace_into(1, after);
    });
    for (const ProbeHit& hit : read_back<ProbeHit>(before, 64)) EXPECT_FLOAT_EQ(hit.distance, 2.0f);
    for (const ProbeHit& hit : read_back<ProbeHit>(after, 64)) EXPECT_FLOAT_EQ(hit.distance, 10.0f);
}

TEST_F(AccelerationTest, MasksHideInstances) {
    const Triangles mesh(device(), corner_triangle(0, 0, 0));
    const BottomLevel level = build_bottom_level(device(), {mesh.geometry()});
    std::vector<TopLevelInstance> instances;
    for (const std::uint8_t mask : {1, 2, 4}) {
        glm::mat4x3 transform(1.0f);
        transform[3].z = -static_cast<float>(mask);
        instances.push_back({.world_from_object = transform, .mask = mask, .bottom_level = level.address()});
    }
    probe_.tracer.set_table({{ProbeProgram::geometry(probe_.narrow, {1})}});
    std::vector<ProbeRay> rays;
    for (std::uint32_t mask = 0; mask < 16; ++mask) {
        rays.push_back(ray_at(0.25f, 0.25f));
        rays.back().mask = mask;
    }
    const auto hits = probe_.trace(instances, rays);
    for (std::uint32_t mask = 0; mask < 16; ++mask) {
        if ((mask & 7) == 0) {
            EXPECT_EQ(hits[mask].shader, shared::PROBE_MISS) << mask;
        } else {
            const std::uint32_t nearest = mask & (~mask + 1);  // the lowest bit
            EXPECT_FLOAT_EQ(hits[mask].distance, 1.0f + static_cast<float>(nearest)) << mask;
        }
    }
}

TEST_F(AccelerationTest, OpaqueGeometriesSkipAnyHitShaders) {
    // Two triangles behind each other; the any-hit shader lets rays through the one with the odd index, in
    // front.
    std::vector<glm::vec3> corners = corner_triangle(0, 0, -5), front = corner_triangle(0, 0, -1);
    corners.insert(corners.end(), front.begin(), front.end());
    const Triangles mesh(device(), corners);
    probe_.tracer.set_table({{ProbeProgram::geometry(probe_.sieve, {1})}});
    for (const bool opaque : {false, true}) {
        const BottomLevel level = build_bottom_level(device(), {mesh.geometry(opaque)});
        const auto hits = probe_.trace({{.bottom_level = level.address()}}, {ray_at(0.25f, 0.25f)});
        EXPECT_FLOAT_EQ(hits[0].distance, opaque ? 2.0f : 6.0f);
        EXPECT_EQ(hits[0].primitive, opaque ? 1u : 0u);
        EXPECT_EQ(hits[0].any_hits > 0, !opaque);
    }
}

TEST_F(AccelerationTest, InstanceFlagsReachTheTraversal) {
    // Counter-clockwise as the ray sees it, so its front in a right-handed system, as in glTF.
    const Triangles mesh(device(), corner_triangle(0, 0, -1));
    const BottomLevel level = build_bottom_level(device(), {mesh.geometry()});
    probe_.tracer.set_table({{ProbeProgram::geometry(probe_.narrow, {1})}});
    ProbeRay culling = ray_at(0.25f, 0.25f);
    culling.flags = 0x10;  // gl_RayFlagsCullBackFacingTrianglesEXT
    using Flag = vk::GeometryInstanceFlagBitsKHR;
    const auto distance = [&](float mirror, vk::GeometryInstanceFlagsKHR flags) {
        glm::mat4x3 transform(1.0f);
        transform[1].y = mirror;
        culling.origin.y = mirror * 0.25f;
        return probe_
            .trace({{.world_from_object = transform, .flags = flags, .bottom_level = level.address()}},
                   {culling})[0]
            .distance;
    };
    EXPECT_FLOAT_EQ(distance(1.0f, {}), 2.0f);
    EXPECT_FLOAT_EQ(distance(1.0f, Flag::eTriangleFlipFacing), -1.0f);
    EXPECT_FLOAT_EQ(distance(1.0f, Flag::eTriangleFlipFacing | Flag::eTriangleFacingCullDisable), 2.0f);
    // Facing is decided in object space, so mirroring an instance keeps its front.
    EXPECT_FLOAT_EQ(distance(-1.0f, {}), 2.0f);
}

TEST_F(AccelerationTest, TheTopLevelGrowsAndShrinks) {
    const Triangles mesh(device(), corner_triangle(0, 0, -1));
    const BottomLevel level = build_bottom_level(device(), {mesh.geometry()});
    probe_.tracer.set_table({{ProbeProgram::geometry(probe_.narrow, {1})}});
    for (const std::uint32_t count : {1u, 100u, 0u, 17u}) {
        std::vector<TopLevelInstance> instances;
        for (std::uint32_t i = 0; i < count; ++i) {
            glm::mat4x3 transform(1.0f);
            transform[3].x = static_cast<float>(2 * i);
            instances.push_back(
                {.world_from_object = transform, .custom_index = 1000 + i, .bottom_level = level.address()});
        }
        std::vector<ProbeRay> rays;
        for (std::uint32_t i = 0; i < 100; ++i)
            rays.push_back(ray_at(static_cast<float>(2 * i) + 0.25f, 0.25f));
        const auto hits = probe_.trace(instances, rays);
        for (std::uint32_t i = 0; i < 100; ++i) {
            EXPECT_EQ(hits[i].custom_index, i < count ? 1000 + i : 0xFFFFFFFFu) << i << " of " << count;
        }
    }
}

TEST_F(AccelerationTest, MoreInstancesThanTheDeviceTakesAreAFault) {
    const TopLevelInstance one;
    // Only the size is looked at.
    const std::span<const TopLevelInstance> many(&one, device().limits().max_instances + 1);
    submit_and_wait(device(),
                    [&](const Commands& cmd) { EXPECT_THROW(probe_.scene.build(cmd, 0, many), Fault); });
}

}  // namespace
}  // namespace foveray::gpu
