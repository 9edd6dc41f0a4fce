#pragma once

#include <optional>
#include <string>

#include "render/gpu/compute_pipeline.h"
#include "render/scene/scene.h"

namespace foveray::user_shapes {

/// Calls a user's functions directly, apart from any ray tracing, and looks whether they keep their word: no
/// NaN, hits within t_min and t_max with a normal, and no surface outside the stated bounds or cut off by
/// them (tolerance: a thousandth of the bounds' diagonal).
class Examination {
  public:
    /// Compiles.
    Examination(const gpu::Device& device, const gpu::TextureTable& textures, const scene::UserShape& shape);

    /// Lets the driver compile: runs the shader without anything to do. Waits.
    void warm_up(const scene::Shape& shape);
    /// What is wrong with a shape of this file, if anything. Waits. `seconds`: session time.
    std::optional<std::string> run(const scene::Shape& shape, std::span<const float> values, float seconds);

  private:
    void dispatch(const scene::Shape& shape, std::span<const float> values, float seconds,
                  std::uint32_t count);

    const gpu::Device& device_;
    gpu::ComputePipeline pipeline_;
    gpu::Buffer record_, findings_;
};

}  // namespace foveray::user_shapes
