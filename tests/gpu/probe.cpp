#include "tests/gpu/probe.h"

#include <numeric>

namespace foveray::gpu {

using engine::HitGroup;
using engine::RayType;

Triangles::Triangles(const Device& device, const std::vector<glm::vec3>& corners)
    : count(static_cast<std::uint32_t>(corners.size() / 3)) {
    std::vector<std::uint32_t> order(corners.size());
    std::iota(order.begin(), order.end(), 0u);
    Uploader uploader(device);
    positions = uploader.buffer("positions", range_bytes(corners), build_input);
    indices = uploader.buffer("indices", range_bytes(order), build_input);
}

TriangleGeometry Triangles::geometry(bool opaque) const {
    return {.positions = positions.address(),
            .position_count = 3 * count,
            .indices = indices.address(),
            .triangle_count = count,
            .opaque = opaque};
}

std::vector<glm::vec3> corner_triangle(float x, float y, float z) {
    return {{x, y, z}, {x + 1.0f, y, z}, {x, y + 1.0f, z}};
}

Boxes::Boxes(const Device& device, const std::vector<vk::AabbPositionsKHR>& all)
    : count(static_cast<std::uint32_t>(all.size())) {
    Uploader uploader(device);
    boxes = uploader.buffer("boxes", range_bytes(all), build_input);
}

BottomLevel build_bottom_level(const Device& device, std::vector<AccelerationGeometry> geometries,
                               bool deforms) {
    const std::vector<BottomLevelInfo> infos = {{"structure", std::move(geometries), deforms}};
    return std::move(build_bottom_levels(device, infos).front());
}

shared::ProbeRay ray_at(float x, float y, std::uint32_t ray_type) {
    return {.origin = {x, y, 1.0f},
            .t_min = 0.0f,
            .direction = {0.0f, 0.0f, -1.0f},
            .t_max = 1000.0f,
            .mask = 0xFF,
            .ray_type = ray_type,
            .flags = 0};
}

ProbeProgram Probe::declare() {
    const std::string shaders = "tests/gpu/";
    ProbeProgram program("probe", RayType{"first", shaders + "first.rmiss"},
                         RayType{"second", shaders + "second.rmiss"},
                         RayType{"third", shaders + "third.rmiss"});
    wide = program.add_geometry_type<shared::WideRecord>(
        "wide", HitGroup{shaders + "wide_first.rchit", "", ""},
        HitGroup{shaders + "wide_second.rchit", "", ""}, HitGroup{});
    const HitGroup narrow_group{shaders + "narrow.rchit", "", ""};
    narrow =
        program.add_geometry_type<shared::NarrowRecord>("narrow", narrow_group, HitGroup{}, narrow_group);
    const HitGroup sieve_group{shaders + "narrow.rchit", shaders + "even.rahit", ""};
    sieve = program.add_geometry_type<shared::NarrowRecord>("sieve", sieve_group, sieve_group, sieve_group);
    const HitGroup sphere_group{shaders + "sphere.rchit", "", shaders + "sphere.rint"};
    sphere = program.add_geometry_type<shared::ProbeSphereRecord>("sphere", sphere_group, sphere_group,
                                                             HitGroup{"", "", shaders + "sphere.rint"});
    probe = program.add_ray_generation(shaders + "probe.rgen");
    second = program.add_ray_generation(shaders + "second.rgen");
    return program;
}

Probe::Probe(const Device& device, std::uint32_t slots)
    : textures(device),
      tracer(device, textures, slots, declare()),
      scene(device, "probe scene", slots),
      device_(device) {}

std::vector<shared::ProbeHit> Probe::trace(const std::vector<TopLevelInstance>& instances,
                                           const std::vector<shared::ProbeRay>& rays, std::uint32_t slot) {
    Uploader uploader(device_);
    const Buffer input = uploader.buffer("rays", range_bytes(rays));
    uploader.flush();
    const Buffer output(device_, "hits", rays.size() * sizeof(shared::ProbeHit), Residence::Device);
    Buffer target(device_, "hits back", output.size(), Residence::Readback);
    submit_and_wait(device_, [&](const Commands& cmd) {
        scene.build(cmd, slot, instances);
        tracer.prepare(cmd, slot, scene);
        tracer.trace(cmd, probe, shared::ProbePush{input.address(), output.address()},
                     {static_cast<std::uint32_t>(rays.size()), 1, 1});
        cmd.barrier(Access::RayTracingWrite, Access::TransferRead);
        cmd->copyBuffer(output.vk(), target.vk(), vk::BufferCopy(0, 0, output.size()));
        cmd.barrier(Access::TransferWrite, Access::HostRead);
    });
    target.invalidate();
    const auto hits = target.mapped_as<shared::ProbeHit>().subspan(0, rays.size());
    return {hits.begin(), hits.end()};
}

std::vector<shared::ProbeHit> Probe::trace(const BottomLevel& structure, std::uint32_t geometry_count,
                                           const std::vector<shared::ProbeRay>& rays) {
    ProbeTracer::Range range;
    for (std::uint32_t i = 0; i < geometry_count; ++i) range.push_back(ProbeProgram::geometry(narrow, {i}));
    tracer.set_table({range});
    return trace({TopLevelInstance{.bottom_level = structure.address()}}, rays);
}

}  // namespace foveray::gpu
