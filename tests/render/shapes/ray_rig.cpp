#include "tests/render/shapes/ray_rig.h"

#include <map>
#include <string>

namespace foveray::render {
namespace {

using engine::HitGroup;
using engine::RayGeneration;
using engine::RayType;
using engine::SceneProgram;
using engine::SceneRayTracer;

/// The same geometry types, whose hit shaders tell which they are and what their record holds. Intersection
/// shaders stay.
SceneProgram debug_program(const SceneProgram& source, RayGeneration& shader) {
    const std::string folder = "tests/shapes/";
    SceneProgram program("records", RayType{"surface", folder + "record_surface.rmiss"},
                         RayType{"shadow", folder + "record_shadow.rmiss"});
    for (std::uint32_t type = 0; type < source.geometry_type_count(); ++type) {
        const std::string closest_hit = folder + "record_" + std::to_string(type) + ".rchit";
        const auto group = [&](std::uint32_t ray_type, const std::string& any_hit) {
            return HitGroup{closest_hit, folder + any_hit, source.hit_group(type, ray_type).intersection};
        };
        // The struct matters to C++ alone.
        program.add_geometry_type<shared::SphereRecord>(source.geometry_type_name(type),
                                                        group(0, "record_surface.rahit"),
                                                        group(1, "record_shadow.rahit"));
    }
    for (const auto& [name, code] : source.own_shaders()) program.add_shader(name, code);
    shader = program.add_ray_generation(folder + "records.rgen");
    return program;
}

}  // namespace

RayRig::RayRig(const gpu::Device& device, const scene::Scene& scene, const UserShaders& users)
    : device_(device),
      textures_(device),
      pipeline_(device, textures_, 1, scene, users),
      animator_(scene),
      gpu_scene_(device, textures_, scene, 1),
      accel_(device, gpu_scene_, pipeline_, 1) {
    accel_.fill_table(pipeline_);
}

template <typename Answer>
std::vector<Answer> RayRig::trace(SceneRayTracer& tracer, RayGeneration shader, Nanoseconds time,
                                  const std::vector<shared::TestRay>& rays, std::uint32_t each) {
    gpu::Uploader uploader(device_);
    const gpu::Buffer input = uploader.buffer("test rays", gpu::range_bytes(rays));
    uploader.flush();
    const auto count = static_cast<std::uint32_t>(rays.size());
    const vk::DeviceSize size = vk::DeviceSize{count} * each * sizeof(Answer);
    const gpu::Buffer output(device_, "test answers", size, gpu::Residence::Device);
    gpu::Buffer target(device_, "test answers back", size, gpu::Residence::Readback);
    changes_ = &animator_.advance(time);
    gpu::submit_and_wait(device_, [&](const gpu::Commands& cmd) {
        const GpuSceneFrame frame = gpu_scene_.record(cmd, 0, *changes_, {});
        instances_.assign(frame.instances.begin(), frame.instances.end());
        accel_.record(cmd, 0, frame, pipeline_);
        tracer.set_table(accel_.table());
        tracer.prepare(cmd, 0, accel_.top_level());
        tracer.trace(cmd, shader, shared::RaysPush{input.address(), output.address()}, {count, each, 1});
        cmd.barrier(gpu::Access::RayTracingWrite, gpu::Access::TransferRead);
        cmd->copyBuffer(output.vk(), target.vk(), vk::BufferCopy(0, 0, size));
        cmd.barrier(gpu::Access::TransferWrite, gpu::Access::HostRead);
    });
    target.invalidate();
    const auto mapped = target.template mapped_as<Answer>().first(std::size_t{count} * each);
    return {mapped.begin(), mapped.end()};
}

std::vector<shared::RayAnswer> RayRig::answers(Nanoseconds time, const std::vector<shared::TestRay>& rays) {
    if (!rays_tracer_) {
        SceneProgram with_rays = pipeline_.tracer().program();
        rays_ = with_rays.add_ray_generation("tests/shapes/rays.rgen");
        rays_tracer_.emplace(device_, textures_, 1, std::move(with_rays));
    }
    return trace<shared::RayAnswer>(*rays_tracer_, rays_, time, rays, 1);
}

std::vector<std::uint32_t> RayRig::steps(const std::vector<shared::TestRay>& rays) {
    const std::map<std::string, std::string> counted = {
        {"render/shapes/mandelbulb.rint", "tests/shapes/count_mandelbulb.rint"},
        {"render/shapes/voxels.rint", "tests/shapes/count_voxels.rint"}};
    SceneProgram program("steps", RayType{"surface", "render/surface.rmiss"},
                         RayType{"shadow", "render/shadow.rmiss"});
    const SceneProgram& source = pipeline_.tracer().program();
    for (std::uint32_t type = 0; type < source.geometry_type_count(); ++type) {
        HitGroup surface = source.hit_group(type, 0), shadow = source.hit_group(type, 1);
        if (const auto shader = counted.find(surface.intersection); shader != counted.end()) {
            surface.intersection = shadow.intersection = shader->second;
        }
        program.add_geometry_type<shared::SphereRecord>(source.geometry_type_name(type), surface, shadow);
    }
    const RayGeneration shader = program.add_ray_generation("tests/shapes/steps.rgen");
    SceneRayTracer tracer(device_, textures_, 1, std::move(program));
    return trace<std::uint32_t>(tracer, shader, 0, rays, 1);
}

std::vector<shared::RecordSeen> RayRig::records(const std::vector<shared::TestRay>& rays) {
    RayGeneration shader;
    SceneRayTracer tracer(device_, textures_, 1, debug_program(pipeline_.tracer().program(), shader));
    return trace<shared::RecordSeen>(tracer, shader, 0, rays, shared::RAY_TYPE_COUNT);
}

}  // namespace foveray::render
