#pragma once

#include <cstdint>

#include "render/engine/scene_types.h"
#include "render/sampling.h"

namespace foveray::render {

/// What the primary rays of one pass found.
struct Surfaces {
    vk::DeviceAddress surfaces = 0;  // shared::StoredSurface[count], by sample
    std::uint32_t count = 0;
    const gpu::Buffer* buffer = nullptr;  // what holds them; belongs to the stage
};

/// Finds the nearest surface of every sample, in all of the scene: virtual things and real surfaces.
class PrimaryStage {
  public:
    /// `primary` is the tracer's entry for "render/primary.rgen". The tracer must outlive the stage.
    PrimaryStage(const engine::SceneRayTracer& tracer, engine::RayGeneration primary);

    /// Stage "primary". The tracer must be prepared for the frame. `counters`: uint[RAY_COUNTER_KINDS *
    /// RAY_COUNTER_SLOTS], to which the rays are added. Orders itself after earlier passes' reads of the
    /// surfaces; ray tracing and compute shaders recorded afterwards see them. They last until the next
    /// record().
    Surfaces record(const gpu::Commands& cmd, const SampleGrid& grid, std::uint32_t sub_sample,
                    vk::DeviceAddress counters);

  private:
    const engine::SceneRayTracer& tracer_;
    engine::RayGeneration primary_;
    gpu::Buffer surfaces_;
};

}  // namespace foveray::render
