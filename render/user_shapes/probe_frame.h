#pragma once

#include <optional>
#include <string>

#include "render/accel_scene.h"
#include "render/primary.h"
#include "render/ray_counters.h"
#include "render/scene/scene_builder.h"
#include "render/user_shapes/probe_request.h"
#include "shaders/shared/surface.h"

namespace foveray::user_shapes {

/// A scene of one shape, looked at from all around and from its middle, as a frame would trace it.
class ProbeFrame {
  public:
    /// Compiles. `shape` is the user's file 0.
    ProbeFrame(const gpu::Device& device, gpu::TextureTable& textures, const scene::UserShape& user,
               const scene::Shape& shape);

    /// Lets the driver compile: traces rays that meet nothing. Waits.
    void warm_up();
    /// Why a shape is refused, and which function is to blame.
    struct Finding {
        std::string reason;
        bool of_color = false;  // color_at, not the surface's function
    };
    /// What is wrong with what the rays find of a shape of the same file, if anything. Waits.
    std::optional<Finding> run(const ProbeMoment& moment);

  private:
    std::vector<shared::Surface> look(std::span<const View> views, const ProbeMoment& moment);

    scene::Scene scene_;
    scene::SceneAnimator animator_;
    gpu::FrameRing ring_;
    render::RayPipeline pipeline_;
    render::GpuScene gpu_scene_;
    render::AccelScene accel_;
    render::PrimaryStage primary_;
    render::RayCounters counters_;
    gpu::Buffer grid_, readback_;
};

}  // namespace foveray::user_shapes
