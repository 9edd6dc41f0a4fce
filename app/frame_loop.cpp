#include "app/frame_loop.h"

#include <chrono>
#include <utility>

#include "app/frame_metrics.h"
#include "app/room_proxies.h"

namespace foveray::app {
namespace {

constexpr float room_distance =
    3.0f;  // metres: how far the room is taken to be where no real surface is known

std::vector<xr::ViewPicture> pictures_of(const render::ViewImages& images) {
    std::vector<xr::ViewPicture> pictures;
    for (const auto& buffers : images.buffers)
        pictures.push_back({buffers.color->vk(), 0, buffers.depth->vk(), 0});
    return pictures;
}

void point_gaze(Frame& frame, vec2 pointer) {
    const View& view = frame.views.front();
    frame.gaze.valid = frame.has_eye_tracking = true;
    frame.gaze.time = frame.display_time;
    frame.gaze.origin = view.stage_from_eye.position;
    frame.gaze.direction =
        glm::normalize(transform_direction(view.stage_from_eye, direction_at(view.fov, pointer)));
}

}  // namespace

FrameLoop::FrameLoop(const FrameLoopSetup& setup)
    : device_(setup.device),
      headset_(setup.headset),
      camera_(setup.camera),
      every_pixel_(setup.every_pixel),
      acuity_(setup.acuity),
      world_from_stage_(setup.scene->world_from_stage),
      textures_(setup.device),
      ring_(setup.device, setup.frames_in_flight),
      counters_(setup.device, setup.frames_in_flight),
      live_(setup.device, textures_, setup.frames_in_flight, setup.scene, setup.user_shaders),
      room_(setup.device, textures_, setup.frames_in_flight, setup.calibration, room_proxies(*setup.scene),
            room_distance),
      probes_(setup.device, textures_, *setup.scene, live_.pipeline().tracer(), live_.pipeline().probes()),
      sampling_(setup.device, setup.frames_in_flight, live_.pipeline().tracer(), live_.pipeline().fixation()),
      primary_(live_.pipeline().tracer(), live_.pipeline().primary()),
      shadows_(setup.device, textures_, live_.pipeline().tracer(), live_.pipeline().shadows()),
      lighting_(live_.pipeline().tracer(), live_.pipeline().lighting()),
      history_(setup.device, textures_),
      resolve_(setup.device, textures_),
      compositor_(setup.device, textures_),
      submitted_(setup.frames_in_flight) {}

std::optional<FrameLoop::Step> FrameLoop::step(const SettingsOf& settings_of, std::optional<vec2> pointer) {
    std::optional<Frame> begun = headset_.begin_frame();
    if (!begun) return std::nullopt;
    Frame frame = std::move(*begun);
    if (!frame.should_render) {
        wait();  // holds nobody up, and frees what was replaced
        headset_.end_frame(frame);
        return Step{std::move(frame), false, {}};
    }
    if (pointer && !frame.has_eye_tracking) point_gaze(frame, *pointer);
    if (!acuity_) acuity_ = acuity_for(frame.views);

    const gpu::Commands cmd = ring_.begin();
    const auto start = std::chrono::steady_clock::now();
    const std::uint32_t slot = ring_.slot();
    collect_metrics(slot);  // of the slot's earlier frame, which is done
    const Settings settings = settings_of(frame);
    counters_.clear(cmd);

    const auto& changes = live_.animator().advance(frame.time);
    const auto scene = live_.gpu().record(cmd, slot, changes, world_from_stage_);
    const auto fovea = foveation_.update(frame, settings);
    live_.accel().record(cmd, slot, scene, live_.pipeline(),
                         {frame, world_from_stage_, fovea, *acuity_, settings, every_pixel_});
    const auto room = room_.record(cmd, slot, room_moment(frame), settings);
    const auto probes = probes_.record(cmd, {changes, scene.scene_data, counters_.address(), settings,
                                             live_.pipeline().shapes().follow_time(live_.scene())});
    const auto grid = sampling_.record(
        cmd, slot,
        {frame, world_from_stage_, fovea, headset_.hidden_meshes(), *acuity_, settings, every_pixel_});
    render::Surfaces hits;
    render::LightLayers light;
    for (std::uint32_t sub_sample = 0; sub_sample < grid.sub_sample_count; ++sub_sample) {
        hits = primary_.record(cmd, grid, sub_sample, counters_.address());
        const auto shadows = shadows_.record(
            cmd, {grid, hits, scene.scene_data, scene.light_count, counters_.address(), settings},
            sub_sample);
        light = lighting_.accumulate(cmd,
                                     {grid, hits.surfaces, shadows, scene.scene_data, room.params,
                                      counters_.address(), shadows_.noise(), probes.field, settings},
                                     sub_sample);
    }
    light =
        history_.record(cmd, {grid, hits, light, live_.scene().changes_what_is_behind, frame.time, settings});
    const auto images = resolve_.images(cmd, frame.views, live_.scene().changes_what_is_behind);
    const auto background = passthrough::choose_background(camera_ != nullptr, frame.blend, settings);
    for (std::size_t view = 0; view < frame.views.size(); ++view) {
        resolve_.record(cmd, light, grid, images, view, settings);
        compositor_.record(cmd, frame.views[view], images.images[view], room, scene.scene_data, background,
                           settings);
    }
    headset_.record_submission(cmd, frame, pictures_of(images));
    counters_.read_back(cmd, slot);

    const auto end = std::chrono::steady_clock::now();
    submitted_[slot] = Submitted{frame, every_pixel_ ? uvec2(0) : uvec2(grid.polar.width, grid.polar.height),
                                 std::chrono::duration<double, std::milli>(end - start).count()};
    ring_.submit();
    headset_.end_frame(frame);
    return Step{std::move(frame), true, images};
}

void FrameLoop::show(render::LiveScene::Next next) {
    live_.show(ring_, std::move(next));
    world_from_stage_ = live_.scene().world_from_stage;
    room_.set_surfaces(room_proxies(live_.scene()));
    probes_.set_scene(live_.scene());
}

passthrough::RoomMoment FrameLoop::room_moment(const Frame& frame) {
    head_history_.add(frame.time, frame.stage_from_head);
    passthrough::RoomMoment moment;
    moment.world_from_stage = world_from_stage_;
    if (camera_) moment.picture = camera_->at(frame.time);
    if (moment.picture) moment.stage_from_head = head_history_.at(moment.picture->capture_time);
    return moment;
}

void FrameLoop::wait() {
    ring_.wait();
    collect_metrics(ring_.slot());
}

void FrameLoop::collect_metrics(std::uint32_t slot) {
    if (!submitted_[slot]) return;
    const Submitted& submitted = *submitted_[slot];
    FrameMetrics metrics = frame_metrics(submitted.frame, world_from_stage_, sampling_.gaze_frames(slot));
    metrics.polar_size = submitted.polar_size;
    metrics.cpu_ms = submitted.cpu_ms;
    const render::RayCounts counts = counters_.counts(slot);
    metrics.rays = {counts[shared::COUNT_PRIMARY],    counts[shared::COUNT_SHADOW],
                    counts[shared::COUNT_REFLECTION], counts[shared::COUNT_TRANSPARENT],
                    counts[shared::COUNT_PROBE],      counts[shared::COUNT_OCCLUSION]};
    for (const gpu::StageTime& time : ring_.stage_times())
        metrics.stages.emplace_back(time.name, time.milliseconds);
    finished_ = std::move(metrics);
    submitted_[slot].reset();
}

}  // namespace foveray::app
