#include "render/history.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "render/grow.h"
#include "shaders/shared/history.h"

namespace foveray::render {
namespace {

/// Share of a new frame, `dt` after the one before.
float blend_after(Nanoseconds dt) {
    const Nanoseconds step = std::max(dt, nanoseconds_per_millisecond);
    return static_cast<float>(1.0 -
                              std::pow(0.1, to_seconds(step) / to_seconds(HistoryStage::settling_time)));
}

}  // namespace

HistoryStage::HistoryStage(const gpu::Device& device, const gpu::TextureTable& textures)
    : guide_(device, "render/history_guide.comp", textures, sizeof(shared::HistoryPush)),
      spatial_(device, "render/history_spatial.comp", textures, sizeof(shared::HistoryPush)),
      temporal_(device, "render/history_temporal.comp", textures, sizeof(shared::HistoryPush)) {
    for (std::size_t i = 0; i < kept_.size(); ++i) {
        kept_[i].frame = gpu::Buffer(device, "history frame " + std::to_string(i),
                                     sizeof(shared::HistoryFrame), gpu::Residence::Device);
    }
}

LightLayers HistoryStage::record(const gpu::Commands& cmd, const HistoryInput& input) {
    using gpu::Access;
    const SampleGrid& grid = input.grid;
    if (grid.kind != shared::GRID_POLAR) {
        started_ = false;
        return input.light;
    }
    const auto stage = cmd.stage("history");
    const std::uint32_t layers = input.layers ? 3 : 1;
    const Kept& previous = kept_[current_];
    current_ = 1 - current_;
    Kept& kept = kept_[current_];
    const auto reserve = [&](gpu::Buffer& buffer, const char* name, vk::DeviceSize sample_bytes) {
        grow(cmd, buffer, name, grid.sample_count * sample_bytes);
    };
    const vk::DeviceSize light_bytes = layers * sizeof(uvec2);
    const bool temporal = input.settings.history_temporal && started_ && layers == layers_;
    reserve(kept.guides, "sample guides", sizeof(shared::SampleGuide));
    reserve(kept.result, "settled light", light_bytes);
    if (temporal) {
        reserve(places_, "previous places", sizeof(shared::PreviousPlace));
        reserve(smoothed_, "smoothed light", light_bytes);
    }

    shared::HistoryPush push{};
    push.grid = grid.at(0);
    push.surfaces = input.surfaces.surfaces;
    push.samples = input.light.samples;
    push.shadowed = input.light.shadowed;
    push.guides = kept.guides.address();
    push.previous_guides = previous.guides.address();
    push.places = temporal ? places_.address() : 0;
    push.smoothed = temporal ? smoothed_.address() : kept.result.address();
    push.result = kept.result.address();
    push.previous_result = previous.result.address();
    push.frame = kept.frame.address();
    push.previous_frame = previous.frame.address();
    push.layers = layers;
    push.flags = input.settings.history_spatial ? shared::HISTORY_SPATIAL : 0u;
    push.blend = blend_after(input.time - last_time_);
    push.white = std::exp2(-input.settings.exposure_ev);

    const vk::Extent3D samples{grid.polar.width, grid.polar.height, 2};
    cmd.barrier(Access::ComputeRead, Access::ComputeWrite);  // earlier frames
    guide_.dispatch(cmd, push, {grid.sample_count, 1, 1}, {64, 1, 1});
    cmd.barrier(Access::ComputeWrite, Access::ComputeRead);
    spatial_.dispatch(cmd, push, samples, {16, 8, 1});
    cmd.barrier(Access::ComputeWrite, Access::ComputeRead);
    if (temporal) {
        temporal_.dispatch(cmd, push, samples, {16, 8, 1});
        cmd.barrier(Access::ComputeWrite, Access::ComputeRead);
    }
    started_ = true;
    layers_ = layers;
    last_time_ = input.time;

    LightLayers result = input.light;
    result.packed = kept.result.address();
    result.packed_layers = layers;
    result.guides = kept.guides.address();
    return result;
}

}  // namespace foveray::render
