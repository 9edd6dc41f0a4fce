#pragma once

#include "base/settings.h"
#include "render/engine/scene_types.h"
#include "render/gpu/compute_pipeline.h"
#include "render/primary.h"
#include "render/sampling.h"

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
/// all only where they, or those of neighbours, disagree: in penumbras. Those are gathered in a list, so that
/// the rays of a penumbra run side by side.
class ShadowStage {
  public:
    struct Entries {
        engine::RayGeneration shadows,
            penumbras;  // the tracer's for "render/shadows.rgen", "render/penumbras.rgen"
    };
    ShadowStage(const gpu::Device& device, const gpu::TextureTable& textures,
                const engine::SceneRayTracer& tracer, Entries entries);

    /// Stage "shadows". Ray-tracing shaders recorded afterwards see the result, until the next record().
    Shadows record(const gpu::Commands& cmd, const ShadowInput& input, std::uint32_t sub_sample);

    vk::DeviceAddress noise() const { return noise_.address(); }  // uint[BLUE_NOISE_SIZE²]

  private:
    const gpu::Device& device_;
    const engine::SceneRayTracer& tracer_;
    Entries entries_;
    gpu::ComputePipeline select_;
    gpu::Buffer noise_, visibility_, openness_, penumbras_;
};

}  // namespace foveray::render
