#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/frame_buffer.h"
#include "render/gpu/compute_pipeline.h"
#include "render/gpu_mesh.h"
#include "render/scene/animator.h"

namespace foveray::render {

/// The vertices of all skinned and morphed meshes, this frame's and those of the frame before, computed on
/// the GPU (glTF 2.0 sections 3.7.2.2 and 3.7.3). Skinned vertices come out in world space.
class DeformStage {
  public:
    /// `rest` holds the undeformed mesh of each of the scene's deformations; they must outlive the stage.
    DeformStage(const gpu::Device& device, const gpu::TextureTable& textures, gpu::Uploader& uploader,
                const scene::Scene& scene, std::span<const GpuMesh* const> rest, std::uint32_t slots);

    /// The deformation's primitives, at addresses that never change.
    const std::vector<GpuGeometry>& geometries(scene::DeformationId id) const {
        return meshes_[id].geometries;
    }

    /// Computes the vertices of what differs from the last frame recorded. Orders itself after earlier
    /// frames' use of the vertices, and before this frame's builds and traces.
    void record(const gpu::Commands& cmd, std::uint32_t slot,
                std::span<const scene::DeformationState> states);
    /// The recorded frame's vertices differ from those of the frame before; true in the first frame.
    bool changed(scene::DeformationId id) const { return meshes_[id].changed; }

  private:
    struct Inputs {  // of a primitive
        gpu::Buffer skin, targets;
        std::uint32_t target_count = 0;
    };
    struct Mesh {
        const GpuMesh* rest = nullptr;
        std::vector<Inputs> inputs;
        gpu::Buffer positions, previous_positions, attributes;
        FrameBuffer joints, weights;
        std::vector<GpuGeometry> geometries;
        // State of the last frame recorded.
        std::vector<mat4> last_joints;
        std::vector<float> last_weights;
        bool started = false, changed = false;
    };

    static void copy_to_previous(const gpu::Commands& cmd, const Mesh& mesh);
    void dispatch(const gpu::Commands& cmd, const Mesh& mesh) const;

    gpu::ComputePipeline pipeline_;
    std::vector<Mesh> meshes_;
};

}  // namespace foveray::render
