#include "tests/render/geometry/scene_rig.h"

#include <map>
#include <set>

namespace foveray::render {

SceneRig::Shared& SceneRig::shared_for(const gpu::Device& device, const scene::Scene& scene) {
    static std::map<std::set<scene::ShapeKind>, Shared> by_kinds;
    std::set<scene::ShapeKind> kinds;
    for (const scene::Shape& shape : scene.shapes) kinds.insert(shape.kind);
    return by_kinds.try_emplace(kinds, device, scene).first->second;
}

SceneRig::SceneRig(const gpu::Device& device, const scene::Scene& scene)
    : device_(device),
      ring_(device, slots),
      textures_(shared_for(device, scene).textures),
      pipeline_(shared_for(device, scene).pipeline),
      animator_(scene),
      gpu_scene_(device, textures_, scene, slots),
      accel_(device, gpu_scene_, pipeline_, slots),
      primary_(pipeline_.tracer(), pipeline_.primary()),
      shadows_(device, textures_, pipeline_.tracer(), pipeline_.shadows()),
      lighting_(pipeline_.tracer(), pipeline_.lighting()),
      resolve_(device, textures_),
      counters_(device, slots) {
    accel_.fill_table(pipeline_);
}

SampleGrid SceneRig::upload_grid(std::span<const View> views, const Pose& world_from_stage) {
    auto [params, grid] = pixel_grid(views, world_from_stage);
    ring_.wait();
    grid_ = gpu::Buffer(device_, "test grid", sizeof params, gpu::Residence::Upload);
    grid_.write(gpu::bytes_of(params));
    grid.grids = grid_.address();
    return grid;
}

std::vector<shared::Surface> SceneRig::surfaces(Nanoseconds time, std::span<const View> views,
                                                const Pose& world_from_stage) {
    const SampleGrid grid = upload_grid(views, world_from_stage);
    const vk::DeviceSize size = grid.sample_count * sizeof(shared::StoredSurface);
    readback_ = gpu::Buffer(device_, "test readback", size, gpu::Residence::Readback);
    changes_ = &animator_.advance(time);

    const gpu::Commands cmd = ring_.begin();
    counters_.clear(cmd);
    const GpuSceneFrame frame = gpu_scene_.record(cmd, ring_.slot(), *changes_, world_from_stage);
    masks_.clear();
    for (const GpuInstance& instance : frame.instances) masks_.push_back(instance.mask);
    accel_.record(cmd, ring_.slot(), frame, pipeline_);
    const Surfaces hits = primary_.record(cmd, grid, 0, counters_.address());
    cmd.barrier(gpu::Access::RayTracingWrite, gpu::Access::TransferRead);
    cmd->copyBuffer(hits.buffer->vk(), readback_.vk(), vk::BufferCopy(0, 0, size));
    cmd.barrier(gpu::Access::TransferWrite, gpu::Access::HostRead);
    counters_.read_back(cmd, ring_.slot());
    ring_.submit();
    ring_.wait();
    readback_.invalidate();
    std::vector<shared::Surface> result;
    for (const auto& stored : readback_.mapped_as<shared::StoredSurface>().first(grid.sample_count))
        result.push_back(shared::surface_of(stored));
    return result;
}

std::vector<vec4> SceneRig::picture(Nanoseconds time, const View& view, const Settings& settings) {
    const SampleGrid grid = upload_grid({&view, 1}, {});
    const vk::DeviceSize size = grid.sample_count * sizeof(shared::ResolvedPixel);
    readback_ = gpu::Buffer(device_, "test readback", size, gpu::Residence::Readback);
    changes_ = &animator_.advance(time);

    const gpu::Commands cmd = ring_.begin();
    counters_.clear(cmd);
    const GpuSceneFrame frame = gpu_scene_.record(cmd, ring_.slot(), *changes_, {});
    accel_.record(cmd, ring_.slot(), frame, pipeline_);
    const Surfaces hits = primary_.record(cmd, grid, 0, counters_.address());
    const Shadows shadows = shadows_.record(
        cmd, {grid, hits, frame.scene_data, frame.light_count, counters_.address(), settings}, 0);
    const LightLayers light = lighting_.accumulate(cmd,
                                                   {grid, hits.surfaces, shadows, frame.scene_data, 0,
                                                    counters_.address(), shadows_.noise(), 0, settings},
                                                   0);
    const ViewImages images = resolve_.images(cmd, {&view, 1}, false);
    resolve_.record(cmd, light, grid, images, 0, settings);
    cmd.barrier(gpu::Access::ComputeWrite, gpu::Access::TransferRead);
    cmd->copyBuffer(images.resolved->vk(), readback_.vk(), vk::BufferCopy(0, 0, size));
    cmd.barrier(gpu::Access::TransferWrite, gpu::Access::HostRead);
    ring_.submit();
    ring_.wait();
    readback_.invalidate();
    std::vector<vec4> result;
    for (const shared::ResolvedPixel& pixel :
         readback_.mapped_as<shared::ResolvedPixel>().first(grid.sample_count)) {
        result.push_back(shared::unpack_halves(pixel.radiance));
    }
    return result;
}

View view_forward(float half_angle_degrees, uvec2 size) {
    View view;
    const float a = radians(half_angle_degrees);
    view.fov = {-a, a, a, -a};
    view.size = size;
    return view;
}

std::vector<glm::dvec3> directions_of(const View& view) {
    std::vector<glm::dvec3> result;
    for (std::uint32_t y = 0; y < view.size.y; ++y) {
        for (std::uint32_t x = 0; x < view.size.x; ++x) {
            const vec2 uv = (vec2(x, y) + 0.5f) / vec2(view.size);
            result.emplace_back(view.stage_from_eye.orientation * direction_at(view.fov, uv));
        }
    }
    return result;
}

}  // namespace foveray::render
