#include "render/sampling.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "render/grow.h"
#include "render/polar_map.h"
#include "render/visibility_mask.h"
#include "shaders/shared/fixation.h"

namespace foveray::render {
namespace {

constexpr vk::DeviceSize mask_bytes = hidden_mask_words * sizeof(std::uint32_t);

/// Positions that cover a pixel evenly however many are taken: Roberts' R2 sequence, moved so that their mean
/// is the pixel's centre and the picture stays where it is.
std::vector<vec2> sub_sample_positions(std::uint32_t count) {
    std::vector<vec2> positions;
    vec2 sum(0.0f);
    for (std::uint32_t i = 0; i < count; ++i) {
        constexpr double g = 1.32471795724474602596;
        const double x = 0.5 + i / g, y = 0.5 + i / (g * g);
        positions.emplace_back(static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y)));
        sum += positions.back();
    }
    for (vec2& position : positions) position += 0.5f - sum / static_cast<float>(count);
    return positions;
}

/// Adds the parameters of a grid whose kind, samples and blocks are given.
NewSampleGrid with_params(SampleGrid grid, std::span<const View> views, const Pose& world_from_stage) {
    assert(!views.empty() && views.size() <= shared::MAX_VIEWS);
    shared::SampleGrid params{};
    params.kind = grid.kind;
    params.view_count = static_cast<std::uint32_t>(views.size());
    params.sample_count = grid.sample_count;
    params.jitter = vec2(0.5f);
    params.sub_sample_count = grid.sub_sample_count;
    params.polar = grid.polar;
    for (std::size_t i = 0; i < views.size(); ++i) {
        shared::ViewParams& view = params.views[i];
        view = view_params(views[i], world_from_stage);
        view.first_sample = grid.blocks[grid.kind == shared::GRID_PIXELS ? i : view.eye].first;
    }
    return {params, std::move(grid)};
}

/// The samples of both eyes' polar images.
NewSampleGrid polar_grid(const SamplingInput& input) {
    const shared::PolarMap polar =
        widen_fovea(make_polar_map(effective_acuity(input.acuity, input.settings),
                                   input.settings.resolution_scale, input.settings.angular_ratio),
                    input.fovea.radius_degrees);
    const std::uint32_t eye_samples = polar.width * polar.height;
    SampleGrid grid;
    grid.kind = shared::GRID_POLAR;
    grid.sample_count = 2 * eye_samples;
    grid.blocks = {{0, polar.width, polar.height}, {eye_samples, polar.width, polar.height}};
    grid.polar = polar;
    return with_params(std::move(grid), input.frame.views, input.world_from_stage);
}

}  // namespace

Acuity effective_acuity(const Acuity& headset, const Settings& settings) {
    Acuity acuity = headset;
    if (settings.acuity_a > 0.0f) acuity.a = settings.acuity_a;
    if (settings.acuity_b > 0.0f) acuity.b = settings.acuity_b;
    if (settings.cap_ppd > 0.0f) acuity.cap_ppd = settings.cap_ppd;
    return acuity;
}

shared::ViewParams view_params(const View& view, const Pose& world_from_stage) {
    const Pose world_from_eye = world_from_stage * view.stage_from_eye;
    shared::ViewParams params{};
    params.origin = world_from_eye.position;
    params.eye = static_cast<std::uint32_t>(view.eye);
    params.role = static_cast<std::uint32_t>(view.role);
    params.right = transform_direction(world_from_eye, {1.0f, 0.0f, 0.0f});
    params.up = transform_direction(world_from_eye, {0.0f, 1.0f, 0.0f});
    params.forward = transform_direction(world_from_eye, {0.0f, 0.0f, -1.0f});
    params.tangents = {std::tan(view.fov.left), std::tan(view.fov.right), std::tan(view.fov.up),
                       std::tan(view.fov.down)};
    params.size = view.size;
    return params;
}

NewSampleGrid pixel_grid(std::span<const View> views, const Pose& world_from_stage) {
    SampleGrid grid;
    grid.kind = shared::GRID_PIXELS;
    for (const View& view : views) {
        grid.blocks.push_back({grid.sample_count, view.size.x, view.size.y});
        grid.sample_count += view.size.x * view.size.y;
    }
    return with_params(std::move(grid), views, world_from_stage);
}

SamplingStage::SamplingStage(const gpu::Device& device, std::uint32_t slots,
                             const engine::SceneRayTracer& tracer, engine::RayGeneration fixation)
    : device_(device),
      tracer_(tracer),
      fixation_(fixation),
      slots_(slots),
      gaze_frames_(device, "gaze frames", 2 * sizeof(shared::GazeFrame), gpu::Residence::Device),
      state_(device, "fixation state", sizeof(shared::FixationState), gpu::Residence::Device) {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        const std::string suffix = " " + std::to_string(i);
        slots_[i].masks = gpu::Buffer(device, "visibility masks" + suffix, shared::MAX_VIEWS * mask_bytes,
                                      gpu::Residence::Upload);
        slots_[i].gaze_frames = gpu::Buffer(device, "gaze frames read back" + suffix, gaze_frames_.size(),
                                            gpu::Residence::Readback);
    }
}

vk::DeviceAddress SamplingStage::hidden_mask(Slot& slot, std::size_t view, const Fov& fov,
                                             std::span<const HiddenMesh> hidden) {
    if (view >= hidden.size() || hidden[view].indices.empty()) return 0;
    Mask& mask = masks_[view];
    if (mask.change == 0 || mask.version != hidden[view].version || mask.fov != fov) {
        mask.version = hidden[view].version;
        mask.fov = fov;
        mask.words = hidden_cells(hidden[view], fov);
        ++mask.change;
    }
    if (mask.words.empty()) return 0;
    if (slot.mask_change[view] != mask.change) {
        slot.masks.write(gpu::range_bytes(mask.words), view * mask_bytes);
        slot.mask_change[view] = mask.change;
    }
    return slot.masks.address() + view * mask_bytes;
}

SampleGrid SamplingStage::record(const gpu::Commands& cmd, std::uint32_t slot_index,
                                 const SamplingInput& input) {
    const auto stage = cmd.stage("sampling");
    Slot& slot = slots_[slot_index];
    const std::span<const View> views = input.frame.views;
    auto [params, grid] = input.every_pixel ? pixel_grid(views, input.world_from_stage) : polar_grid(input);
    if (input.every_pixel)
        grid.sub_sample_count = static_cast<std::uint32_t>(input.settings.reference_samples);
    params.sub_sample_count = grid.sub_sample_count;
    params.frame_index = static_cast<std::uint32_t>(input.frame.index);
    params.gaze_frames = gaze_frames_.address();
    for (std::size_t i = 0; i < views.size(); ++i)
        params.views[i].hidden_mask = hidden_mask(slot, i, views[i].fov, input.hidden);

    std::vector<shared::SampleGrid> sub_samples(grid.sub_sample_count, params);
    const std::vector<vec2> positions = sub_sample_positions(grid.sub_sample_count);
    for (std::uint32_t i = 0; i < grid.sub_sample_count; ++i) {
        sub_samples[i].sub_sample = i;
        sub_samples[i].jitter = positions[i];
    }
    grid.grids = upload_grids(cmd, slot, sub_samples);
    record_fixation(cmd, slot, input, grid);
    return grid;
}

// Every ray reads its grid, which must not be in the CPU's memory then.
vk::DeviceAddress SamplingStage::upload_grids(const gpu::Commands& cmd, Slot& slot,
                                              std::span<const shared::SampleGrid> grids) {
    using gpu::Access;
    const vk::DeviceSize bytes = grids.size_bytes();
    if (slot.grid_staging.size() < bytes) {
        slot.grid_staging = gpu::Buffer(device_, "staging for sample grids", bytes, gpu::Residence::Upload);
    }
    grow(cmd, grids_, "sample grids", bytes);
    slot.grid_staging.write(std::as_bytes(grids));
    for (const Access read : {Access::RayTracingRead, Access::ComputeRead})
        cmd.barrier(read, Access::TransferWrite);
    cmd->copyBuffer(slot.grid_staging.vk(), grids_.vk(), vk::BufferCopy(0, 0, bytes));
    for (const Access read : {Access::RayTracingRead, Access::ComputeRead})
        cmd.barrier(Access::TransferWrite, read);
    return grids_.address();
}

void SamplingStage::record_fixation(const gpu::Commands& cmd, Slot& slot, const SamplingInput& input,
                                    const SampleGrid& grid) {
    using gpu::Access;
    const Nanoseconds now = input.frame.time;
    const double steps =
        started_ ? to_seconds(std::max<Nanoseconds>(now - last_time_, 0)) / to_seconds(smoothing_time)
                 : std::numeric_limits<double>::infinity();
    started_ = true;
    last_time_ = now;

    shared::FixationPush push{};
    push.grid = grid.grids;
    push.gaze_frames = gaze_frames_.address();
    push.state = state_.address();
    push.origin = transform_point(input.world_from_stage, input.fovea.origin);
    push.direction = glm::normalize(transform_direction(input.world_from_stage, input.fovea.direction));
    push.far_distance = far_distance;
    push.blend = static_cast<float>(1.0 - std::exp(-steps));

    // Earlier frames may still read the gaze frames.
    cmd.barrier(Access::RayTracingWrite, Access::RayTracingWrite);
    cmd.barrier(Access::ComputeRead, Access::RayTracingWrite);
    cmd.barrier(Access::TransferRead, Access::RayTracingWrite);
    tracer_.trace(cmd, fixation_, push, {1, 1, 1});
    cmd.barrier(Access::RayTracingWrite, Access::RayTracingRead);
    cmd.barrier(Access::RayTracingWrite, Access::ComputeRead);
    cmd.barrier(Access::RayTracingWrite, Access::TransferRead);
    cmd->copyBuffer(gaze_frames_.vk(), slot.gaze_frames.vk(), vk::BufferCopy(0, 0, gaze_frames_.size()));
    cmd.barrier(Access::TransferWrite, Access::HostRead);
}

std::array<shared::GazeFrame, 2> SamplingStage::gaze_frames(std::uint32_t slot) const {
    const gpu::Buffer& buffer = slots_[slot].gaze_frames;
    buffer.invalidate();
    const auto frames = buffer.mapped_as<shared::GazeFrame>();
    return {frames[0], frames[1]};
}

}  // namespace foveray::render
