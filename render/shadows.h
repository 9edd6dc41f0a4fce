#pragma once

#include "base/settings.h"
#include "render/engine/scene_types.h"
#include "render/gpu/compute_pipeline.h"
#include "render/primary.h"
#include "render/sampling.h"

namespace foveray::shared {
struct ShadowPush;
}

namespace foveray::render {

/// What reaches each primary surface of the first lights and of the light from all round.
struct Shadows {
    vk::DeviceAddress visibility = 0;  // uint[light][sample]: shaders/shared/shadows.h
    vk::DeviceAddress openness = 0;    // float[sample]: of the light from all round, 0 … 1
    std::uint32_t light_count = 0;     // the scene's first ones
};

struct ShadowInput {
    const SampleGrid& grid;
    const Surfaces& surfaces;
    vk::DeviceAddress scene;     // shared::SceneData
    std::uint32_t light_count;   // of the scene
    vk::DeviceAddress counters;  // RayCounters
    const Settings& settings;
};

/// Traces the shadows of primary surfaces. From 16 samples a light on it looks first with a few, and takes
/// more only where they, or those of neighbours, disagree: in penumbras. Those are gathered in a list, so
/// that the rays of penumbras run side by side. Of 64 or 256 samples a part is taken first there, and the
/// rest only next to where neighbouring parts of the light are seen differently (after Whitted 1980, section
/// 4: what its antialiasing does for pixels).
class ShadowStage {
  public:
    struct Entries {
        // The tracer's for "render/shadows.rgen", "render/penumbras.rgen", "render/penumbra_rays.rgen".
        engine::RayGeneration shadows, penumbras, penumbra_rays;
    };
    ShadowStage(const gpu::Device& device, const gpu::TextureTable& textures,
                const engine::SceneRayTracer& tracer, Entries entries);

    /// Stage "shadows". Ray-tracing shaders recorded afterwards see the result, until the next record().
    Shadows record(const gpu::Commands& cmd, const ShadowInput& input, std::uint32_t sub_sample);

    vk::DeviceAddress noise() const { return noise_.address(); }  // uint[BLUE_NOISE_SIZE²]

  private:
    const engine::SceneRayTracer& tracer_;
    Entries entries_;
    struct Penumbras;  // where their lists lie
    void trace_penumbras(const gpu::Commands& cmd, const shared::ShadowPush& push,
                         const Penumbras& penumbras) const;

    gpu::ComputePipeline select_, cells_, sums_;
    gpu::Buffer noise_, visibility_, openness_, lists_, words_;
};

}  // namespace foveray::render
