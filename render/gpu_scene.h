#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/deform.h"
#include "render/environment_light.h"
#include "render/frame_buffer.h"
#include "render/gpu_mesh.h"
#include "render/gpu_shapes.h"
#include "render/mesh_store.h"
#include "render/scene/animator.h"
#include "render/scene_textures.h"

namespace foveray::render {

/// What one bottom-level structure is built of.
struct GpuStructure {
    enum class Kind { Mesh, DeformedMesh, Shape, RealSurface };

    std::string name;
    Kind kind = Kind::Mesh;
    std::uint32_t source = 0;             // id of the mesh, deformation, shape or real surface
    std::vector<GpuGeometry> geometries;  // of triangles; a shape has one box instead
    /// Errors of a mesh and of its levels of detail, which are the structures after it: object space, metres,
    /// the first 0. Empty: it has none, or is one.
    std::vector<float> level_errors;
    std::shared_ptr<SharedMesh> shared;  // of which this is a level; null for others
    std::uint32_t level = 0;
};

/// A structure in the world in one frame.
struct GpuInstance {
    std::uint32_t structure = 0;
    mat4 world_from_object{1.0f};
    std::uint32_t mask = 0;  // shared::MASK_…; 0: not there
    bool mirrored_vertices =
        false;  // the vertices were mirrored before world_from_object: triangles face the other way
};

/// What a frame's shaders and builds find; good until the next record().
struct GpuSceneFrame {
    vk::DeviceAddress scene_data = 0;  // shared::SceneData
    std::uint32_t light_count = 0;
    std::span<const GpuInstance> instances;  // by gl_InstanceCustomIndexEXT: meshes, shapes, real surfaces
    std::span<const std::uint8_t>
        structure_changed;  // by structure: its vertices or box are not those of the frame before
    std::span<const scene::ShapeState> shapes;  // by shape id
    float seconds = 0.0f;                       // session time
};

/// A scene on the GPU: uploaded once, then each frame brought to the state that the animator gives.
/// Everything is reached by device address; textures are in the texture table.
class GpuScene {
  public:
    /// `slots`: frames in flight. The scene and the table must outlive this. Uploads and waits, on any
    /// thread; `portion`: bytes that may occupy the GPU at once. `store`: has the meshes of other scenes;
    /// null: none are shared.
    GpuScene(const gpu::Device& device, gpu::TextureTable& textures, const scene::Scene& scene,
             std::uint32_t slots, vk::DeviceSize portion = gpu::whole_portion, MeshStore* store = nullptr);

    const scene::Scene& scene() const { return scene_; }
    /// Meshes that are in use, their levels of detail after each, then deformed meshes, shapes, real
    /// surfaces.
    const std::vector<GpuStructure>& structures() const { return structures_; }
    const GpuShapes& shapes() const { return *shapes_; }
    vk::DeviceAddress materials() const { return materials_.address(); }      // shared::Material[]
    vk::DeviceAddress instances() const { return instance_data_.address(); }  // shared::InstanceData[]

    /// Stage "scene". Once a frame, in order; the slot's earlier frame must be done. Orders itself after
    /// earlier frames' reads and before this frame's builds, traces and compute shaders.
    GpuSceneFrame record(const gpu::Commands& cmd, std::uint32_t slot, const scene::SceneChanges& changes,
                         const Pose& world_from_stage);

  private:
    void upload_structures(const gpu::Device& device, gpu::TextureTable& textures, gpu::Uploader& uploader,
                           std::uint32_t slots, MeshStore& store);
    /// The mesh's geometries of a level with this scene's materials.
    std::vector<GpuGeometry> geometries_of(scene::MeshId id, std::uint32_t level) const;
    void update_instances(const scene::SceneChanges& changes, const Pose& world_from_stage);
    /// The scene's materials, those of them that change as they are now.
    void record_materials(const gpu::Commands& cmd, std::uint32_t slot, const scene::SceneChanges& changes);

    const scene::Scene& scene_;
    gpu::Uploader uploader_;
    SceneTextures textures_;
    EnvironmentLight environment_;
    std::vector<std::shared_ptr<SharedMesh>> meshes_;  // by mesh id; null: not in use
    std::unique_ptr<DeformStage> deform_;
    std::unique_ptr<GpuShapes> shapes_;
    FrameBuffer materials_, instance_data_, lights_, scene_data_;
    std::vector<shared::Material> packed_materials_;
    std::vector<GpuStructure> structures_;
    std::vector<std::uint32_t> structure_of_instance_;  // parallel to instances_
    std::vector<GpuInstance> instances_;
    std::vector<shared::InstanceData> previous_;  // parallel to instances_
    std::vector<std::uint8_t> structure_changed_;
    std::uint32_t first_deformed_ = 0, first_shape_ = 0;  // among the structures
    bool started_ = false;
};

}  // namespace foveray::render
