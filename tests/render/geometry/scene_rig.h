#pragma once

#include <span>
#include <vector>

#include "base/settings.h"
#include "base/view.h"
#include "render/accel_scene.h"
#include "render/lighting.h"
#include "render/primary.h"
#include "render/ray_counters.h"
#include "render/resolve.h"
#include "shaders/shared/surface.h"

namespace foveray::render {

/// A scene on the device, with the stages that look at it; every pixel's centre is a sample. One at a time.
class SceneRig {
  public:
    SceneRig(const gpu::Device& device, const scene::Scene& scene);

    /// What the primary stage finds at a time: view by view, row by row. Times are given in order.
    std::vector<shared::Surface> surfaces(Nanoseconds time, std::span<const View> views,
                                          const Pose& world_from_stage = {});
    /// Radiance of virtual things, and coverage, of one lit view.
    std::vector<vec4> picture(Nanoseconds time, const View& view, const Settings& settings);

    const scene::SceneChanges& changes() const { return *changes_; }  // of the last time looked at
    /// Instance masks of the last time looked at: the scene's instances, then its real surfaces.
    const std::vector<std::uint32_t>& masks() const { return masks_; }
    RayCounts counts() const { return counters_.counts(ring_.slot()); }

  private:
    SampleGrid upload_grid(std::span<const View> views, const Pose& world_from_stage);

    static constexpr std::uint32_t slots = 2;

    /// Pipelines take long to make, so all scenes with the same kinds of shapes share one.
    struct Shared {
        Shared(const gpu::Device& device, const scene::Scene& scene)
            : textures(device), pipeline(device, textures, slots, scene) {}
        gpu::TextureTable textures;
        RayPipeline pipeline;
    };
    static Shared& shared_for(const gpu::Device& device, const scene::Scene& scene);

    const gpu::Device& device_;
    gpu::FrameRing ring_;
    gpu::TextureTable& textures_;
    RayPipeline& pipeline_;
    scene::SceneAnimator animator_;
    GpuScene gpu_scene_;
    AccelScene accel_;
    PrimaryStage primary_;
    ShadowStage shadows_;
    LightingStage lighting_;
    ResolveStage resolve_;
    RayCounters counters_;
    gpu::Buffer grid_, readback_;
    const scene::SceneChanges* changes_ = nullptr;
    std::vector<std::uint32_t> masks_;
};

/// Looks from the stage's origin along -z with equal half-angles.
View view_forward(float half_angle_degrees, uvec2 size);
/// Where each pixel's centre looks, in stage space; not normalised.
std::vector<glm::dvec3> directions_of(const View& view);

}  // namespace foveray::render
