#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/frame.h"
#include "base/headset_profile.h"
#include "base/settings.h"
#include "render/engine/scene_types.h"
#include "render/foveation.h"
#include "render/gpu/commands.h"
#include "shaders/shared/sample_grid.h"

namespace foveray::render {

/// Samples that lie in a rectangle, row by row: an eye's polar image (a row a circle's angle), or a view's
/// pixels. Stages launch their rays block by block, so that rays traced together are neighbours in both
/// directions.
struct SampleBlock {
    std::uint32_t first = 0, width = 0, height = 0;
};

/// Which directions a frame samples, as the later stages take it.
struct SampleGrid {
    vk::DeviceAddress grids = 0;  // shared::SampleGrid[sub_sample_count]
    std::uint32_t kind = shared::GRID_POLAR;
    std::uint32_t sample_count = 0;      // of all eyes or views, culled ones included
    std::uint32_t sub_sample_count = 1;  // passes over the grid, to be averaged; 1 for polar grids
    std::vector<SampleBlock> blocks;     // all samples, in order
    shared::PolarMap polar{};            // of a polar grid

    vk::DeviceAddress at(std::uint32_t sub_sample) const {
        return grids + sub_sample * sizeof(shared::SampleGrid);
    }
};

/// The headset's acuity with what the settings override.
Acuity effective_acuity(const Acuity& headset, const Settings& settings);
shared::ViewParams view_params(const View& view, const Pose& world_from_stage);

/// A grid that the GPU does not have yet: `params` go where `grid.grids` shall point.
struct NewSampleGrid {
    shared::SampleGrid params{};
    SampleGrid grid;
};
/// A sample in the middle of each pixel, view by view.
NewSampleGrid pixel_grid(std::span<const View> views, const Pose& world_from_stage);

struct SamplingInput {
    const Frame& frame;
    Pose world_from_stage;
    Fovea fovea;
    std::span<const HiddenMesh> hidden;  // by view; empty: everything is seen
    const Acuity& acuity;                // the headset's
    const Settings& settings;
    bool every_pixel =
        false;  // --reference: settings.reference_samples samples for each pixel instead of polar ones
};

/// Decides the frame's rays: the fixation point of the gaze in the scene, a frame round each eye's way there,
/// and the grid of samples.
class SamplingStage {
  public:
    /// Where the gaze meets nothing: half way, in dioptres, between 2 m and infinity.
    static constexpr float far_distance = 4.0f;
    /// Time constant of the smoothing of the fixation distance, which jumps where the gaze crosses an edge.
    static constexpr Nanoseconds smoothing_time = 60 * nanoseconds_per_millisecond;

    /// `fixation` is the tracer's entry for "render/fixation.rgen".
    SamplingStage(const gpu::Device& device, std::uint32_t slots, const engine::SceneRayTracer& tracer,
                  engine::RayGeneration fixation);

    /// The tracer must be prepared for the slot. Ray-tracing and compute shaders recorded afterwards see the
    /// result.
    SampleGrid record(const gpu::Commands& cmd, std::uint32_t slot, const SamplingInput& input);

    /// The eyes' gaze frames, left and right, of the slot's newest frame that the GPU has finished.
    std::array<shared::GazeFrame, 2> gaze_frames(std::uint32_t slot) const;

  private:
    struct Mask {
        std::uint64_t version = 0;
        Fov fov;
        std::vector<std::uint32_t> words;
        std::uint64_t change = 0;  // counts what the words were set to
    };
    struct Slot {
        gpu::Buffer grid_staging, masks, gaze_frames;
        std::array<std::uint64_t, shared::MAX_VIEWS> mask_change{};
    };

    vk::DeviceAddress hidden_mask(Slot& slot, std::size_t view, const Fov& fov,
                                  std::span<const HiddenMesh> hidden);
    vk::DeviceAddress upload_grids(const gpu::Commands& cmd, Slot& slot,
                                   std::span<const shared::SampleGrid> grids);
    void record_fixation(const gpu::Commands& cmd, Slot& slot, const SamplingInput& input,
                         const SampleGrid& grid);

    const gpu::Device& device_;
    const engine::SceneRayTracer& tracer_;
    engine::RayGeneration fixation_;
    std::vector<Slot> slots_;
    std::array<Mask, shared::MAX_VIEWS> masks_;
    gpu::Buffer grids_, gaze_frames_, state_;
    bool started_ = false;
    Nanoseconds last_time_ = 0;
};

}  // namespace foveray::render
