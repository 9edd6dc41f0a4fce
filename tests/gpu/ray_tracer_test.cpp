#include "render/engine/ray_tracer.h"

#include <cstring>

#include "tests/fakes/expect_fault.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/gpu/probe.h"

namespace foveray::gpu {
namespace {

using shared::ProbeHit;
using shared::ProbeRay;

class RayTracerTest : public fakes::GpuTest {
  protected:
    Probe probe_{device(), 2};
};

shared::WideRecord wide_record(std::uint32_t id) {
    const auto f = static_cast<float>(id);
    return {(std::uint64_t{id} << 40) + 3, id, f + 0.5f, {f + 1.0f, f + 2.0f, f + 3.0f}, ~id};
}

std::vector<std::uint32_t> words_of(const shared::WideRecord& r) {
    std::vector<std::uint32_t> words(sizeof(r) / 4);
    std::memcpy(words.data(), &r, sizeof(r));
    return words;
}

// Spheres that are met at the same distance as the triangles of corner_triangle(…, -1).
shared::ProbeSphereRecord sphere_record(float y, std::uint32_t id) {
    return {{0.25f, y + 0.25f, -1.5f}, 0.5f, id};
}

vk::AabbPositionsKHR sphere_box(float y) { return {-0.25f, y - 0.25f, -2.0f, 0.75f, y + 0.75f, -1.0f}; }

// Meshes of several geometries, in instances that share their records or have their own, asked by every ray
// type. What each must find is counted up here without the index formula.
TEST_F(RayTracerTest, EveryHitFindsItsOwnShaderAndRecord) {
    const Triangles row0(device(), corner_triangle(0, 0, -1)), row1(device(), corner_triangle(0, 2, -1)),
        row2(device(), corner_triangle(0, 4, -1));
    const Boxes box0(device(), {sphere_box(0)}), box1(device(), {sphere_box(2)});
    const BottomLevel mesh =
        build_bottom_level(device(), {row0.geometry(), row1.geometry(), row2.geometry()});
    const BottomLevel spheres = build_bottom_level(device(), {box0.geometry(), box1.geometry()});
    const BottomLevel single = build_bottom_level(device(), {row0.geometry()});

    const auto wide = [&](std::uint32_t id) { return ProbeProgram::geometry(probe_.wide, wide_record(id)); };
    const auto narrow = [&](std::uint32_t id) { return ProbeProgram::geometry(probe_.narrow, {id}); };
    const auto sphere = [&](float y, std::uint32_t id) {
        return ProbeProgram::geometry(probe_.sphere, sphere_record(y, id));
    };
    const auto offsets = probe_.tracer.set_table({{wide(10), narrow(11), wide(12)},
                                                  {narrow(20), wide(21), wide(22)},
                                                  {sphere(0, 30), sphere(2, 31)},
                                                  {narrow(40)}});

    struct Placed {
        const BottomLevel* structure;
        std::uint32_t range;
        std::vector<std::uint32_t> ids;
    };
    const std::vector<Placed> placed = {{&mesh, 0, {10, 11, 12}}, {&single, 3, {40}},
                                        {&mesh, 0, {10, 11, 12}}, {&spheres, 2, {30, 31}},
                                        {&mesh, 1, {20, 21, 22}}, {&spheres, 2, {30, 31}}};
    std::vector<TopLevelInstance> instances;
    std::vector<ProbeRay> rays;
    for (std::uint32_t i = 0; i < placed.size(); ++i) {
        glm::mat4x3 transform(1.0f);
        transform[3].x = static_cast<float>(3 * i);
        instances.push_back({.world_from_object = transform,
                             .custom_index = 500 + i,
                             .record_offset = offsets[placed[i].range],
                             .bottom_level = placed[i].structure->address()});
        for (std::uint32_t g = 0; g < placed[i].ids.size(); ++g) {
            for (std::uint32_t type = 0; type < shared::PROBE_RAY_TYPES; ++type) {
                rays.push_back(
                    ray_at(static_cast<float>(3 * i) + 0.25f, static_cast<float>(2 * g) + 0.25f, type));
            }
        }
    }
    const auto hits = probe_.trace(instances, rays);

    const auto is_narrow = [](std::uint32_t id) { return id == 11 || id == 20 || id == 40; };
    const auto is_sphere = [](std::uint32_t id) { return id == 30 || id == 31; };
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < placed.size(); ++i) {
        for (std::uint32_t g = 0; g < placed[i].ids.size(); ++g) {
            for (std::uint32_t type = 0; type < shared::PROBE_RAY_TYPES; ++type, ++next) {
                const std::uint32_t id = placed[i].ids[g];
                const ProbeHit& hit = hits[next];
                SCOPED_TRACE("instance " + std::to_string(i) + " geometry " + std::to_string(g) +
                             " ray type " + std::to_string(type));
                std::uint32_t shader =
                    shared::PROBE_NOTHING;  // hit, but its hit group has no closest-hit shader
                if (is_sphere(id)) {
                    if (type != 2) shader = shared::PROBE_SPHERE;
                } else if (is_narrow(id)) {
                    if (type != 1) shader = shared::PROBE_NARROW;
                } else if (type != 2) {
                    shader = type == 0 ? shared::PROBE_WIDE_FIRST : shared::PROBE_WIDE_SECOND;
                }
                EXPECT_EQ(hit.shader, shader);
                if (shader == shared::PROBE_NOTHING) continue;
                EXPECT_NEAR(hit.distance, 2.0f, 1e-5f);
                EXPECT_EQ(hit.instance, i);
                EXPECT_EQ(hit.custom_index, 500 + i);
                EXPECT_EQ(hit.geometry, g);
                EXPECT_EQ(hit.primitive, 0u);
                if (is_narrow(id) || is_sphere(id)) {
                    EXPECT_EQ(hit.record[0], id);
                } else {
                    EXPECT_EQ(std::vector(std::begin(hit.record), std::end(hit.record)),
                              words_of(wide_record(id)));
                }
            }
        }
    }
    EXPECT_EQ(next, hits.size());
}

TEST_F(RayTracerTest, EachRayTypeHasItsMissShader) {
    const auto hits = probe_.trace({}, {ray_at(0, 0, 0), ray_at(0, 0, 1), ray_at(0, 0, 2)});
    for (std::uint32_t type = 0; type < 3; ++type) EXPECT_EQ(hits[type].shader, shared::PROBE_MISS + type);
}

TEST_F(RayTracerTest, ChangedRecordsArriveInEverySlot) {
    const Triangles mesh(device(), corner_triangle(0, 0, -1));
    const BottomLevel level = build_bottom_level(device(), {mesh.geometry()});
    const auto seen = [&](std::uint32_t slot, std::uint32_t record_offset) {
        return probe_
            .trace({{.record_offset = record_offset, .bottom_level = level.address()}},
                   {ray_at(0.25f, 0.25f)}, slot)[0]
            .record[0];
    };
    const auto narrow = [&](std::uint32_t id) { return ProbeProgram::geometry(probe_.narrow, {id}); };
    probe_.tracer.set_table({{narrow(7)}});
    EXPECT_EQ(seen(0, 0), 7u);
    EXPECT_EQ(seen(1, 0), 7u);
    probe_.tracer.set_table({{narrow(8)}});
    EXPECT_EQ(seen(0, 0), 8u);
    EXPECT_EQ(seen(1, 0), 8u);
    EXPECT_EQ(seen(0, 0), 8u);
    // A larger table, then a smaller one.
    const auto offsets = probe_.tracer.set_table({std::vector(300, narrow(1)), {narrow(9)}});
    EXPECT_EQ(offsets[1], 300 * shared::PROBE_RAY_TYPES);
    EXPECT_EQ(seen(1, offsets[1]), 9u);
    EXPECT_EQ(seen(1, 0), 1u);
    probe_.tracer.set_table({{narrow(10)}});
    EXPECT_EQ(seen(1, 0), 10u);
    EXPECT_EQ(seen(0, 0), 10u);
}

TEST_F(RayTracerTest, EntriesAreFoundByOffsetGeometryAndRayType) {
    const auto wide = [&](std::uint32_t id) { return ProbeProgram::geometry(probe_.wide, wide_record(id)); };
    const auto narrow = [&](std::uint32_t id) { return ProbeProgram::geometry(probe_.narrow, {id}); };
    const auto offsets = probe_.tracer.set_table({{wide(10), narrow(11)}, {}, {narrow(20), wide(21)}});
    const ProbeProgram& program = probe_.tracer.program();
    const ProbeTracer& tracer = probe_.tracer;
    for (std::uint32_t type = 0; type < shared::PROBE_RAY_TYPES; ++type) {
        const auto& first = tracer.entry(offsets[0], 1, type);
        EXPECT_EQ(first.ray_type, type);
        EXPECT_EQ(program.hit_groups()[first.hit_group], program.hit_group(probe_.narrow.index, type));
        EXPECT_EQ(std::get<shared::NarrowRecord>(first.record).id, 11u);
        const auto& last = tracer.entry(offsets[2], 1, type);
        EXPECT_EQ(program.hit_groups()[last.hit_group], program.hit_group(probe_.wide.index, type));
        EXPECT_EQ(std::get<shared::WideRecord>(last.record).id, 21u);
    }
    // Of the newest table.
    probe_.tracer.set_table({{narrow(5)}});
    EXPECT_EQ(std::get<shared::NarrowRecord>(tracer.entry(0, 0, 2).record).id, 5u);
    const auto expect_none = [&](std::uint32_t offset, std::uint32_t geometry, std::uint32_t type,
                                 const std::string& part) {
        fakes::expect_fault([&] { tracer.entry(offset, geometry, type); }, ExitCode::Internal, part);
        fakes::expect_fault([&] { tracer.entry(offset, geometry, type); }, ExitCode::Internal,
                            "program \"probe\"");
    };
    expect_none(0, 1, 0,
                "the shader table has 3 hit records for 3 ray types, none for record offset 0, geometry 1, "
                "ray type 0");
    expect_none(0, 0, 3, "ray type 3");
    expect_none(1, 0, 0, "record offset 1");
    expect_none(0xFFFFFFFFu, 0xFFFFFFFFu, 0, "geometry 4294967295");
}

TEST_F(RayTracerTest, RayGenerationShadersShareTheTable) {
    const Buffer output(device(), "hits", 24 * sizeof(ProbeHit), Residence::Device);
    submit_and_wait(device(), [&](const Commands& cmd) {
        probe_.scene.build(cmd, 0, {});
        probe_.tracer.prepare(cmd, 0, probe_.scene);
        const auto stage = cmd.stage("second");
        const shared::ProbePush push{0, output.address()};
        probe_.tracer.trace(cmd, probe_.second, push, {2, 3, 4});
        probe_.tracer.trace(cmd, probe_.second, push, {0, 3, 4});  // no rays
    });
    const auto hits = read_back<ProbeHit>(output, 24);
    for (std::uint32_t i = 0; i < 24; ++i) EXPECT_EQ(hits[i].shader, 1000 + i);
}

}  // namespace
}  // namespace foveray::gpu
