#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/settings.h"
#include "render/engine/scene_types.h"
#include "render/gpu/compute_pipeline.h"
#include "render/scene/animator.h"
#include "render/scene/probe_grid.h"
#include "shaders/shared/probes.h"

namespace foveray::render {

/// Light that comes by way of surfaces, all over the scene.
struct ProbeField {
    vk::DeviceAddress field = 0;  // shared::ProbeField; 0: the scene has no probes, or they are off
};

struct ProbeInput {
    const scene::SceneChanges& changes;
    vk::DeviceAddress scene;     // shared::SceneData
    vk::DeviceAddress counters;  // RayCounters
    const Settings& settings;
    bool shapes_follow_time = false;  // ShapeTypes::follow_time
};

/// Dynamic diffuse global illumination on the scene's grid of probes: shaders/shared/probes.h says after
/// whom. Each frame every probe that is awake sends rays, turned by one of a cycle of rotations, and blends
/// what they see into its maps, by session time: over `slowest` seconds in a scene that is still, faster
/// since its last change, over `fastest` where the light changes at once.
class ProbeStage {
  public:
    static constexpr float slowest = 4.0f;
    static constexpr float usual = 0.4f;  // while the scene changes
    static constexpr float fastest = 0.04f;

    /// `probes` is the tracer's entry for "render/probe_trace.rgen". The tracer must outlive the stage.
    ProbeStage(const gpu::Device& device, const gpu::TextureTable& textures, const scene::Scene& scene,
               const engine::SceneRayTracer& tracer, engine::RayGeneration probes);

    /// From the next record() on: another scene, or other code of its users' shapes. Where probes stay where
    /// they were, they keep what they know, and look for what has changed.
    void set_scene(const scene::Scene& scene);

    /// Stage "probes". The tracer must be prepared for the frame. Orders itself after earlier frames' use of
    /// the field; ray tracing and compute shaders recorded afterwards see this frame's.
    ProbeField record(const gpu::Commands& cmd, const ProbeInput& input);

    /// For read-back in tests: shared::ProbeState a probe, and the packed maps.
    const gpu::Buffer& states() const { return states_; }
    const gpu::Buffer& light() const { return light_; }
    const gpu::Buffer& depth() const { return depth_; }
    /// What shaders read at ProbeField::field. Only with probes.
    const shared::ProbeField& field() const { return field_; }

  private:
    /// New probes, where the wanted grid has them.
    void place(const gpu::Commands& cmd);
    void set_directions(const gpu::Commands& cmd, std::uint32_t ray_count);
    /// Brings the clocks below to this frame. Returns the seconds that it takes.
    float advance(const ProbeInput& input);
    shared::ProbePush push_of(const ProbeInput& input, float seconds) const;

    const engine::SceneRayTracer& tracer_;
    engine::RayGeneration probes_;
    gpu::ComputePipeline update_;
    std::optional<scene::ProbeGrid> wanted_grid_, grid_;
    std::uint32_t probe_count_ = 0;
    shared::ProbeField field_{};
    gpu::Buffer field_buffer_, states_, light_, depth_, light_sums_, depth_sums_, rays_, directions_;

    bool scene_changed_ = false;
    std::uint32_t ray_count_ = 0;
    std::uint32_t frame_ = 0;
    std::optional<Nanoseconds> last_time_;
    std::vector<std::byte> lighting_;  // what light depended on in the last frame, besides geometry
    // Seconds of session time.
    float since_start_ = 0.0f, since_change_ = 0.0f, since_geometry_change_ = 0.0f;
};

/// Directions evenly over the sphere (spherical Fibonacci points), in an order in which neighbours are close
/// together. Unit length.
std::vector<vec3> probe_directions(std::uint32_t count);
/// One of a cycle of shared::PROBE_ROTATIONS rotations, evenly over all that there are.
quat probe_rotation(std::uint32_t frame);

}  // namespace foveray::render
