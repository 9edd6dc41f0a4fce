#include <gtest/gtest.h>

#include "base/error.h"
#include "render/engine/program.h"
#include "render/engine/table_layout.h"
#include "shaders/shared/ray_types.h"
#include "tests/fakes/expect_fault.h"

namespace foveray::engine {
namespace {

TEST(HitRecordIndex, EqualsCountingInstancesGeometriesAndRayTypes) {
    for (std::uint32_t ray_types = 1; ray_types <= 15; ++ray_types) {
        const std::vector<std::uint32_t> geometry_counts = {3, 1, 0, 7, 2};
        const auto offsets = record_offsets(geometry_counts, ray_types);
        ASSERT_EQ(offsets.size(), geometry_counts.size());
        std::uint32_t next = 0;
        for (std::size_t range = 0; range < geometry_counts.size(); ++range) {
            for (std::uint32_t geometry = 0; geometry < geometry_counts[range]; ++geometry) {
                for (std::uint32_t ray_type = 0; ray_type < ray_types; ++ray_type, ++next) {
                    EXPECT_EQ(shared::hit_record_index(offsets[range], geometry, ray_type, ray_types), next);
                }
            }
        }
    }
}

TEST(HitRecordIndex, StaysWithinTheInstancesTwentyFourBits) {
    EXPECT_EQ(record_offsets(std::vector<std::uint32_t>{(1u << 23) - 1, 1}, 2)[1], (1u << 24) - 2);
    EXPECT_THROW(record_offsets(std::vector<std::uint32_t>{(1u << 23), 1}, 2), Fault);
    EXPECT_THROW(record_offsets(std::vector<std::uint32_t>{1u << 31, 1u << 31, 1}, 15), Fault);
}

gpu::RayTracingLimits limits(std::uint32_t handle, std::uint32_t handle_alignment, std::uint32_t base,
                             std::uint32_t max_stride) {
    gpu::RayTracingLimits l;
    l.handle_size = handle;
    l.handle_alignment = handle_alignment;
    l.base_alignment = base;
    l.max_record_stride = max_stride;
    return l;
}

TEST(TableLayout, FollowsEachDevicesAlignments) {
    struct Case {
        gpu::RayTracingLimits limits;
        std::uint32_t record_size;
        TableLayout expected;
    };
    const std::vector<Case> cases = {
        // 32 + 56 = 88, up to 96: three handles of 32 bytes.
        {limits(32, 32, 64, 4096), 56, {{0, 64, 3}, {192, 32, 2}, {256, 96, 10}, 256 + 960}},
        // 32 + 56 = 88, up to 128 at a coarser alignment; misses take 64 each.
        {limits(32, 64, 64, 4096), 56, {{0, 64, 3}, {192, 64, 2}, {320, 128, 10}, 320 + 1280}},
        // A base alignment finer than the handles'.
        {limits(32, 32, 16, 4096), 0, {{0, 32, 3}, {96, 32, 2}, {160, 32, 10}, 160 + 320}},
        // A handle larger than its alignment.
        {limits(48, 16, 256, 4096), 20, {{0, 256, 3}, {768, 48, 2}, {1024, 80, 10}, 1024 + 800}},
    };
    for (const Case& c : cases) {
        const TableLayout layout = lay_out_table(c.limits, {3, 2, 10}, c.record_size);
        EXPECT_EQ(layout.ray_generation, c.expected.ray_generation);
        EXPECT_EQ(layout.miss, c.expected.miss);
        EXPECT_EQ(layout.hit, c.expected.hit);
        EXPECT_EQ(layout.size, c.expected.size);
        EXPECT_EQ(layout.hit.record(3), c.expected.hit.offset + 3 * c.expected.hit.stride);
    }
}

TEST(TableLayout, RegionsNeverOverlapAndAreAlignedForManyLimits) {
    for (const std::uint32_t handle_alignment : {1u, 8u, 16u, 32u, 64u}) {
        for (const std::uint32_t base : {16u, 32u, 64u, 128u, 256u}) {
            for (std::uint32_t record = 0; record < 200; record += 12) {
                const TableLayout l =
                    lay_out_table(limits(32, handle_alignment, base, 4096), {2, 3, 5}, record);
                for (const TableRegion& r : {l.ray_generation, l.miss, l.hit}) {
                    EXPECT_EQ(r.offset % base, 0u);
                    EXPECT_EQ(r.stride % handle_alignment, 0u);
                    EXPECT_GE(r.stride, 32u);
                }
                EXPECT_EQ(l.ray_generation.stride % base, 0u);
                EXPECT_GE(l.hit.stride, 32u + record);
                EXPECT_LE(l.ray_generation.offset + l.ray_generation.size(), l.miss.offset);
                EXPECT_LE(l.miss.offset + l.miss.size(), l.hit.offset);
                EXPECT_EQ(l.hit.offset + l.hit.size(), l.size);
            }
        }
    }
}

TEST(TableLayout, ARecordLargerThanTheDeviceAllowsIsAFault) {
    EXPECT_NO_THROW(lay_out_table(limits(32, 32, 64, 96), {1, 1, 1}, 64));
    try {
        lay_out_table(limits(32, 32, 64, 96), {1, 1, 1}, 65);
        FAIL() << "no fault";
    } catch (const Fault& fault) {
        EXPECT_EQ(fault.code(), ExitCode::Missing);
        EXPECT_NE(std::string(fault.what()).find("128 bytes"), std::string::npos);
        EXPECT_NE(std::string(fault.what()).find("96"), std::string::npos);
    }
}

struct Ball {
    float radius;
};
struct Cube {
    float side;
    std::uint32_t id;
};
struct Stranger {
    float value;
};
using TwoTypes = Program<2, Ball, Cube>;

TEST(ProgramTest, EntriesFollowRangesGeometriesAndRayTypes) {
    TwoTypes program("test", RayType{"surface", "a.rmiss"}, RayType{"shadow", "b.rmiss"});
    const HitGroup ball_surface{"ball.rchit", "", "ball.rint"}, ball_shadow{"", "", "ball.rint"};
    const HitGroup cube_surface{"cube.rchit", "", ""};
    const auto ball = program.add_geometry_type<Ball>("ball", ball_surface, ball_shadow);
    const auto cube = program.add_geometry_type<Cube>("cube", cube_surface, HitGroup{});
    const auto glass_cube =
        program.add_geometry_type<Cube>("glass cube", cube_surface, HitGroup{"", "glass.rahit", ""});
    EXPECT_EQ(program.hit_groups().size(), 5u) << "the same hit group is kept once";
    EXPECT_EQ(program.hit_group(ball.index, 1), ball_shadow);

    const auto entries =
        program.entries({{TwoTypes::geometry(cube, {1.0f, 10}), TwoTypes::geometry(ball, {2.0f})},
                         {},
                         {TwoTypes::geometry(glass_cube, {3.0f, 30})}});
    ASSERT_EQ(entries.size(), 6u);
    const std::vector<HitGroup> groups = {cube_surface, {},           ball_surface,
                                          ball_shadow,  cube_surface, {"", "glass.rahit", ""}};
    for (std::size_t i = 0; i < entries.size(); ++i) {
        EXPECT_EQ(entries[i].ray_type, i % 2);
        EXPECT_EQ(program.hit_groups()[entries[i].hit_group], groups[i]) << i;
    }
    EXPECT_EQ(std::get<Cube>(entries[1].record).id, 10u);
    EXPECT_EQ(std::get<Ball>(entries[2].record).radius, 2.0f);
    EXPECT_EQ(std::get<Cube>(entries[5].record).id, 30u);
}

TwoTypes balls_and_cubes() {
    TwoTypes program("toys", RayType{"surface", "a.rmiss"}, RayType{"shadow", "b.rmiss"});
    program.add_geometry_type<Ball>("ball", HitGroup{"ball.rchit", "", "ball.rint"},
                                    HitGroup{"", "", "ball.rint"});
    program.add_geometry_type<Cube>("cube", HitGroup{"cube.rchit", "", ""}, HitGroup{});
    program.add_geometry_type<Cube>("glass cube", HitGroup{"glass.rchit", "", ""}, HitGroup{});
    return program;
}

TEST(ProgramTest, TellsWhatWasDeclared) {
    TwoTypes program = balls_and_cubes();
    EXPECT_EQ(program.name(), "toys");
    EXPECT_EQ(program.ray_types()[1].name, "shadow");
    EXPECT_EQ(program.ray_types()[1].miss_shader, "b.rmiss");
    EXPECT_EQ(program.geometry_type_count(), 3u);
    EXPECT_EQ(program.geometry_type<Ball>("ball").index, 0u);
    EXPECT_EQ(program.geometry_type<Cube>("glass cube").index, 2u);
    EXPECT_EQ(program.geometry_type_name(2), "glass cube");
    EXPECT_EQ(program.hit_group(0, 0), (HitGroup{"ball.rchit", "", "ball.rint"}));
    EXPECT_EQ(program.hit_group(2, 0), (HitGroup{"glass.rchit", "", ""}));
    EXPECT_EQ(program.hit_group(2, 1), HitGroup{});
    const RayGeneration second =
        (program.add_ray_generation("first.rgen"), program.add_ray_generation("b.rgen"));
    EXPECT_EQ(program.ray_generation().at(second.index), "b.rgen");
    program.add_shader("own", {1, 2});
    program.add_shader("own", {3});
    EXPECT_EQ(program.own_shaders().at("own"), std::vector<std::uint32_t>{3});
}

TEST(ProgramTest, WhatIsMissingOrOfAnotherTypeIsNamed) {
    TwoTypes program = balls_and_cubes();
    const auto expect = [](auto action, const std::string& part) {
        fakes::expect_fault(action, ExitCode::Internal, part);
        fakes::expect_fault(action, ExitCode::Internal, "program \"toys\"");
    };
    expect([&] { program.geometry_type<Ball>("cone"); }, "there is no geometry type \"cone\"");
    expect([&] { program.geometry_type<Ball>("cube"); },
           "the records of geometry type \"cube\" are of another type");
    expect([&] { program.add_geometry_type<Ball>("cube", HitGroup{}, HitGroup{}); },
           "geometry type \"cube\" is added twice");
    expect(
        [&] {
            program.add_geometry_type<Ball>("disc", HitGroup{"", "", "disc.rint"}, HitGroup{});
        },
        "geometry type \"disc\" has an intersection shader for some ray types only");
    EXPECT_EQ(program.geometry_type_count(), 3u) << "what is refused leaves nothing behind";
}

// What must not compile.
template <class P, class Record, class... HitGroups>
concept CanAdd = requires(P program, HitGroups... groups) {
    program.template add_geometry_type<Record>("x", groups...);
};
template <class P, class Type, class Record>
concept CanPlace = requires(Type type, Record record) {
    P::geometry(type, record);
};

template <class P, class Record>
concept CanAsk = requires(const P program) {
    program.template geometry_type<Record>("x");
};

static_assert(CanAdd<TwoTypes, Ball, HitGroup, HitGroup>);
static_assert(!CanAdd<TwoTypes, Ball, HitGroup>, "a missing entry");
static_assert(!CanAdd<TwoTypes, Ball, HitGroup, HitGroup, HitGroup>);
static_assert(!CanAdd<TwoTypes, Stranger, HitGroup, HitGroup>, "an undeclared record");
static_assert(CanPlace<TwoTypes, GeometryType<Ball>, Ball>);
static_assert(!CanPlace<TwoTypes, GeometryType<Ball>, Cube>, "another type's record");
static_assert(!CanPlace<TwoTypes, GeometryType<Stranger>, Stranger>);
static_assert(CanAsk<TwoTypes, Cube>);
static_assert(!CanAsk<TwoTypes, Stranger>, "an undeclared record");
static_assert(!std::is_constructible_v<TwoTypes, std::string, RayType>, "a missing ray type");
static_assert(std::is_constructible_v<TwoTypes, std::string, RayType, RayType>);

}  // namespace
}  // namespace foveray::engine
