#pragma once

#include <array>

#include "base/settings.h"
#include "base/time.h"
#include "render/gpu/compute_pipeline.h"
#include "render/lighting.h"
#include "render/primary.h"
#include "render/sampling.h"

namespace foveray::render {

struct HistoryInput {
    const SampleGrid& grid;
    const Surfaces& surfaces;
    const LightLayers& light;
    bool layers = false;   // Scene::changes_what_is_behind: what becomes of the light behind is kept too
    Nanoseconds time = 0;  // of display
    const Settings& settings;
};

/// Takes out of polar images what coarse sampling leaves in them, in polar space: the noise of shadows by
/// averaging what arrives over neighbours on the same surface, and edges that crawl as the head turns by
/// blending each sample with what earlier frames saw of the same point. Both grow from nothing at the gaze,
/// where the picture must stay as sharp as it is sampled. Both eyes are treated alike, each by itself. Pixel
/// grids pass through.
class HistoryStage {
  public:
    /// A step in the lighting has reached 90 % of itself after so long, whatever the frame rate.
    static constexpr Nanoseconds settling_time = 80 * nanoseconds_per_millisecond;

    HistoryStage(const gpu::Device& device, const gpu::TextureTable& textures);

    /// Stage "history". Once a frame, in order. Compute shaders recorded afterwards see the result.
    LightLayers record(const gpu::Commands& cmd, const HistoryInput& input);

  private:
    /// What a frame leaves to the next. Frames alternate between two.
    struct Kept {
        gpu::Buffer guides, result, frame;
    };

    gpu::ComputePipeline guide_, spatial_, temporal_;
    std::array<Kept, 2> kept_;
    gpu::Buffer places_, smoothed_;
    std::size_t current_ = 0;
    bool started_ = false;
    std::uint32_t layers_ = 0;  // that the frame before kept
    Nanoseconds last_time_ = 0;
};

}  // namespace foveray::render
