#include "app/offscreen/offscreen.h"

#include <chrono>
#include <cmath>

#include "render/grow.h"
#include "render/polar_map.h"
#include "shaders/shared/ray_log.h"

namespace foveray::app {
namespace {

constexpr float room_distance = 3.0f;

Pose pose_of(const mat4& matrix) {
    return {
        glm::normalize(glm::quat_cast(mat3(glm::normalize(vec3(matrix[0])), glm::normalize(vec3(matrix[1])),
                                           glm::normalize(vec3(matrix[2]))))),
        vec3(matrix[3])};
}

Frame frame_of(const Shot& shot, std::uint64_t index) {
    Frame frame;
    frame.index = index;
    frame.time = shot.time;
    frame.should_render = true;
    frame.views = shot.views;
    return frame;
}

}  // namespace

Offscreen::Offscreen(const gpu::Device& device, const scene::Scene& scene, std::uint32_t frames_in_flight,
                     const render::UserShaders& user_shaders)
    : Offscreen(device, std::shared_ptr<const scene::Scene>(std::shared_ptr<void>(), &scene),
                frames_in_flight, user_shaders) {}

Offscreen::Offscreen(const gpu::Device& device, std::shared_ptr<const scene::Scene> scene,
                     std::uint32_t frames_in_flight, const render::UserShaders& user_shaders)
    : device_(device),
      textures_(device),
      ring_(device, frames_in_flight),
      counters_(device, frames_in_flight),
      live_(device, textures_, frames_in_flight, std::move(scene), user_shaders),
      room_(device, textures_, frames_in_flight, std::nullopt, {}, room_distance),
      probes_(device, textures_, live_.scene(), live_.pipeline().tracer(), live_.pipeline().probes()),
      sampling_(device, frames_in_flight, live_.pipeline().tracer(), live_.pipeline().fixation()),
      primary_(live_.pipeline().tracer(), live_.pipeline().primary()),
      shadows_(device, textures_, live_.pipeline().tracer(), live_.pipeline().shadows()),
      lighting_(live_.pipeline().tracer(), live_.pipeline().lighting()),
      history_(device, textures_),
      resolve_(device, textures_),
      compositor_(device, textures_),
      pending_cpu_ms_(frames_in_flight) {}

void Offscreen::show(render::LiveScene::Next next) {
    live_.show(ring_, std::move(next));
    probes_.set_scene(live_.scene());
}

std::optional<ShotCost> Offscreen::draw(const Shot& shot) {
    const gpu::Commands cmd = ring_.begin();
    const auto start = std::chrono::steady_clock::now();
    const std::uint32_t slot = ring_.slot();
    std::optional<ShotCost> earlier = collect(slot);
    const Frame frame = frame_of(shot, frame_++);
    const Settings& settings = shot.settings;
    const render::Fovea fovea{shot.gaze_origin, shot.gaze_direction, 0.0f, true};

    if (shot.bare_rays > 0) empty_log(cmd, shot.bare_rays);
    counters_.clear(cmd, shot.bare_rays > 0 ? ray_log_.address() : 0);
    const auto& changes = live_.animator().advance(shot.time);
    const auto scene = live_.gpu().record(cmd, slot, changes, {});
    live_.accel().record(cmd, slot, scene, live_.pipeline(),
                         {frame, {}, fovea, shot.acuity, settings, shot.every_pixel});
    const auto room = room_.record(cmd, slot, {}, settings);
    const auto probes = probes_.record(cmd, {changes, scene.scene_data, counters_.address(), settings,
                                             live_.pipeline().shapes().follow_time(live_.scene())});
    const auto grid =
        sampling_.record(cmd, slot, {frame, {}, fovea, shot.hidden, shot.acuity, settings, shot.every_pixel});
    render::Surfaces hits;
    render::LightLayers light;
    for (std::uint32_t sub_sample = 0; sub_sample < grid.sub_sample_count; ++sub_sample) {
        hits = primary_.record(cmd, grid, sub_sample, counters_.address());
        const auto shadows = shadows_.record(
            cmd, {grid, hits, scene.scene_data, scene.light_count, counters_.address(), settings},
            sub_sample);
        light = lighting_.accumulate(cmd,
                                     {grid, hits.surfaces, shadows, scene.scene_data, 0, counters_.address(),
                                      shadows_.noise(), probes.field, settings},
                                     sub_sample);
    }
    light =
        history_.record(cmd, {grid, hits, light, live_.scene().changes_what_is_behind, frame.time, settings});
    images_ = resolve_.images(cmd, frame.views, live_.scene().changes_what_is_behind);
    for (std::size_t view = 0; view < frame.views.size(); ++view) {
        resolve_.record(cmd, light, grid, images_, view, settings);
        compositor_.record(cmd, frame.views[view], images_.images[view], room, scene.scene_data,
                           passthrough::Background::Environment, settings);
    }
    counters_.read_back(cmd, slot);
    if (shot.bare_rays > 0) trace_bare(cmd);
    ring_.submit();
    const std::chrono::duration<double, std::milli> cpu = std::chrono::steady_clock::now() - start;
    pending_cpu_ms_[slot] = cpu.count();
    return earlier;
}

void Offscreen::empty_log(const gpu::Commands& cmd, std::uint32_t most) {
    render::grow(cmd, ray_log_, "ray log",
                 sizeof(shared::RayLog) + vk::DeviceSize{most} * sizeof(shared::LoggedRay));
    cmd.barrier(gpu::Access::RayTracingRead, gpu::Access::TransferWrite);
    cmd.barrier(gpu::Access::IndirectRead, gpu::Access::TransferWrite);
    const shared::RayLog empty{0, 1, 1, most};
    cmd->updateBuffer<shared::RayLog>(ray_log_.vk(), 0, empty);
    cmd.barrier(gpu::Access::TransferWrite, gpu::Access::RayTracingWrite);
}

void Offscreen::trace_bare(const gpu::Commands& cmd) {
    cmd.barrier(gpu::Access::RayTracingWrite, gpu::Access::RayTracingRead);
    cmd.barrier(gpu::Access::RayTracingWrite, gpu::Access::IndirectRead);
    const auto stage = cmd.stage("bare");
    const render::RayPipeline& pipeline = live_.pipeline();
    pipeline.tracer().trace_indirect(cmd, pipeline.bare_rays(), shared::BareRaysPush{ray_log_.address()},
                                     ray_log_.address());
}

std::optional<ShotCost> Offscreen::collect(std::uint32_t slot) {
    if (!pending_cpu_ms_[slot]) return std::nullopt;
    ShotCost cost{ring_.stage_times(), counters_.counts(slot), *pending_cpu_ms_[slot]};
    pending_cpu_ms_[slot].reset();
    return cost;
}

std::vector<ShotCost> Offscreen::finish() {
    std::vector<ShotCost> costs;
    for (std::uint32_t i = 0; i < ring_.size(); ++i) {
        ring_.begin();  // waits for the slot's frame and reads its times
        if (auto cost = collect(ring_.slot())) costs.push_back(std::move(*cost));
        ring_.submit();
    }
    ring_.wait();
    return costs;
}

Image Offscreen::picture(std::size_t view) {
    ring_.wait();
    const uvec2 size = images_.images[view].size;
    Image image(size.x, size.y, 4);
    gpu::Buffer readback(device_, "picture", image.pixels.size(), gpu::Residence::Readback);
    gpu::submit_and_wait(device_, [&](const gpu::Commands& cmd) {
        cmd.barrier(gpu::Access::ComputeWrite, gpu::Access::TransferRead);
        cmd->copyBuffer(images_.buffers[view].color->vk(), readback.vk(),
                        vk::BufferCopy(0, 0, image.pixels.size()));
        cmd.barrier(gpu::Access::TransferWrite, gpu::Access::HostRead);
    });
    readback.invalidate();
    const auto bytes = readback.mapped_as<std::uint8_t>();
    std::copy_n(bytes.begin(), image.pixels.size(), image.pixels.begin());
    return image;
}

std::optional<Pose> camera_pose(const scene::Scene& scene) {
    scene::SceneAnimator animator(scene);
    const scene::SceneChanges& start = animator.advance(0);
    for (scene::NodeId id = 0; id < scene.nodes.size(); ++id) {
        if (scene.nodes[id].camera) return pose_of(start.world_from_node[id]);
    }
    return std::nullopt;
}

View camera_view(const scene::Scene& scene, uvec2 size) {
    View view;
    view.size = size;
    view.stage_from_eye = camera_pose(scene).value_or(Pose{});
    const float vertical = scene.cameras.empty() ? radians(50.0f) : scene.cameras.front().vertical_fov;
    const float up = 0.5f * vertical;
    const float right = std::atan(std::tan(up) * static_cast<float>(size.x) / static_cast<float>(size.y));
    view.fov = {-right, right, up, -up};
    return view;
}

std::vector<View> headset_views(const scene::Scene& scene, const HeadsetProfile& profile) {
    const Pose stage_from_head = camera_pose(scene).value_or(Pose{});
    std::vector<View> views;
    for (const HeadsetProfile::ViewProfile& v : profile.views) {
        const float side = v.eye == Eye::Left ? -0.5f : 0.5f;
        const Pose head_from_eye{quat(1.0f, 0.0f, 0.0f, 0.0f), vec3(side * profile.ipd, 0.0f, 0.0f)};
        views.push_back({v.eye, v.role, stage_from_head * head_from_eye, v.fov, v.size});
    }
    return views;
}

void set_polar_size(Shot& shot, uvec2 size) {
    const Acuity acuity = render::effective_acuity(shot.acuity, shot.settings);
    const float samples = render::make_polar_map(acuity, 1.0f, 1.0f).radius_outer;
    shot.settings.resolution_scale =
        (static_cast<float>(size.x) - 0.5f) / samples;  // the width is rounded up
    shot.settings.angular_ratio = static_cast<float>(size.y) / static_cast<float>(size.x);
}

}  // namespace foveray::app
