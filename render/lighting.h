#pragma once

#include "base/settings.h"
#include "render/engine/scene_types.h"
#include "render/gpu/commands.h"
#include "render/sampling.h"
#include "render/shadows.h"
#include "shaders/shared/light_layers.h"

namespace foveray::render {

/// Light of every sample. Over a real surface a picture is
/// radiance + (1 - coverage) (transmittance × camera + added).
struct LightLayers {
    vk::DeviceAddress samples = 0;        // shared::LightSample, by sample
    const gpu::Buffer* buffer = nullptr;  // holds them, for read-back
    vk::DeviceAddress shadowed = 0;       // shared::ShadowedLight, by sample; 0: of pixel grids
    // What the history stage makes of a polar grid's.
    vk::DeviceAddress packed = 0;  // by layer and sample: shaders/shared/history.h
    vk::DeviceAddress guides = 0;  // shared::SampleGuide, by sample
    std::uint32_t packed_layers = 0;
};

struct LightingInput {
    const SampleGrid& grid;
    vk::DeviceAddress surfaces;  // shared::StoredSurface, by sample
    const Shadows& shadows;      // on them
    vk::DeviceAddress scene;     // shared::SceneData
    vk::DeviceAddress room;      // shared::RoomParams; 0: no camera
    vk::DeviceAddress counters;  // RayCounters
    vk::DeviceAddress noise;     // ShadowStage::noise
    vk::DeviceAddress probes;    // shared::ProbeField; 0: none
    const Settings& settings;
};

/// Lights what the primary stage found: punctual and area lights with shadows, environment with ambient
/// occlusion, reflections and refractions, see-through layers, and for real surfaces the virtual shadows and
/// mirror images on them.
class LightingStage {
  public:
    /// `lighting` is the tracer's entry for "render/lighting.rgen".
    LightingStage(const engine::SceneRayTracer& tracer,
                  engine::RayGeneration lighting);

    /// Sub-sample 0 starts a frame's light, the following ones, in order, are averaged into it. Compute and
    /// ray-tracing shaders recorded afterwards see the result.
    LightLayers accumulate(const gpu::Commands& cmd, const LightingInput& input, std::uint32_t sub_sample);

  private:
    const engine::SceneRayTracer& tracer_;
    engine::RayGeneration lighting_;
    gpu::Buffer samples_, shadowed_;
};

}  // namespace foveray::render
