#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/gpu/acceleration.h"
#include "render/gpu_scene.h"
#include "render/mesh_detail.h"
#include "render/ray_pipeline.h"
#include "render/rebuild_plan.h"

namespace foveray::render {

/// The scene as rays find it: a bottom-level structure for each mesh, shape and real surface, and each frame
/// a top-level one over all instances. Instance masks are GpuInstance::mask. Single-sided triangles are
/// invisible to surface rays from behind, and block light from both sides. Instances without a mask are left
/// out.
class AccelScene {
  public:
    /// Builds the structures for such a pipeline, but for those that another scene shares. Waits, on any
    /// thread; `portion`: bytes that may occupy the GPU at once, but for a structure that is larger itself.
    /// The scene must outlive this.
    AccelScene(const gpu::Device& device, const GpuScene& scene, const RayPipeline& pipeline,
               std::uint32_t slots, vk::DeviceSize portion = gpu::whole_portion);

    /// Fills the pipeline's shader table with the scene's geometries: before the first record() with it.
    void fill_table(RayPipeline& pipeline) const;

    /// Stage "acceleration". Makes the frame's structure, of meshes in the levels of detail that suit, and
    /// points the pipeline's slot at it: traces may follow.
    void record(const gpu::Commands& cmd, std::uint32_t slot, const GpuSceneFrame& frame,
                RayPipeline& pipeline, const MeshDetail& detail = {});

    /// Triangles of all instances of the last record(), in the levels that were chosen.
    std::uint64_t triangle_count() const { return triangle_count_; }

    /// What the shader table holds, a range a structure, as of the last record().
    const std::vector<RayPipeline::Range>& table() const { return table_; }
    const gpu::TopLevel& top_level() const { return top_level_; }

  private:
    struct Structure {
        std::vector<gpu::AccelerationGeometry> geometries;
        std::vector<bool> opaque;  // by geometry of triangles
        std::shared_ptr<gpu::BottomLevel> level;
        std::uint32_t record_offset = 0;
        bool any_double_sided = false;
    };

    void build(const gpu::Device& device, vk::DeviceSize portion);
    /// The structure that stands for the instance in this frame.
    std::uint32_t structure_for(const GpuInstance& instance, const MeshDetail& detail) const;
    /// Refits or rebuilds what changed and is to be seen, and its records.
    void update_structures(const gpu::Commands& cmd, const GpuSceneFrame& frame, RayPipeline& pipeline);

    const GpuScene& scene_;
    std::vector<Structure> structures_;  // parallel to GpuScene::structures()
    std::optional<RebuildPlan> plan_;
    std::vector<std::uint8_t> stale_;  // by structure: it has changed since it was last brought up to date
    std::vector<RayPipeline::Range> table_;
    gpu::TopLevel top_level_;
    std::vector<gpu::TopLevelInstance> instances_;
    std::uint64_t triangle_count_ = 0;
};

}  // namespace foveray::render
