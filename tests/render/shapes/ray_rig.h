#pragma once

#include <optional>
#include <vector>

#include "render/accel_scene.h"
#include "shaders/tests/shapes/rays.h"

namespace foveray::render {

/// A scene on the device, into which any rays are traced.
class RayRig {
  public:
    RayRig(const gpu::Device& device, const scene::Scene& scene, const UserShaders& users = {});

    /// What surface and shadow rays find at a time. Times are given in order.
    std::vector<shared::RayAnswer> answers(Nanoseconds time, const std::vector<shared::TestRay>& rays);
    /// Which records the rays lead to, by debug hit shaders: for each ray, each ray type.
    std::vector<shared::RecordSeen> records(const std::vector<shared::TestRay>& rays);

    /// How many steps a surface ray takes: in a scene of one Mandelbulb, or of one voxel object as wide as in
    /// object space.
    std::vector<std::uint32_t> steps(const std::vector<shared::TestRay>& rays);

    const scene::SceneChanges& changes() const { return *changes_; }  // of the last time looked at
    const std::vector<RayPipeline::Range>& table() const { return accel_.table(); }
    const std::vector<GpuInstance>& instances() const { return instances_; }  // of the last time looked at
    const engine::SceneProgram& program() const { return pipeline_.tracer().program(); }

  private:
    template <typename Answer>
    std::vector<Answer> trace(engine::SceneRayTracer& tracer, engine::RayGeneration shader, Nanoseconds time,
                              const std::vector<shared::TestRay>& rays, std::uint32_t each);

    const gpu::Device& device_;
    gpu::TextureTable textures_;
    RayPipeline pipeline_;
    scene::SceneAnimator animator_;
    GpuScene gpu_scene_;
    AccelScene accel_;
    engine::RayGeneration rays_;
    std::optional<engine::SceneRayTracer> rays_tracer_;
    std::vector<GpuInstance> instances_;
    const scene::SceneChanges* changes_ = nullptr;
};

}  // namespace foveray::render
