#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "render/scene/scene_builder.h"

namespace foveray::scene {

/// One glTF 2.0 file (.gltf or .glb). Construction reads and checks all of it and adds its images, materials
/// and meshes to the builder; `instantiate` may be called several times and shares them. Throws
/// Fault(BadInput) naming the file, the JSON pointer of the place and the remedy.
///
/// Extensions: KHR_lights_punctual, KHR_texture_transform, KHR_materials_unlit,
/// KHR_materials_emissive_strength, KHR_mesh_quantization, EXT_mesh_gpu_instancing. Others are named in a
/// warning, or refused if the file requires them. Points and lines are skipped with a warning.
class GltfModel {
  public:
    GltfModel(SceneBuilder& builder, const std::filesystem::path& file);
    ~GltfModel();

    struct Use {
        std::optional<NodeId> parent;
        std::optional<std::uint32_t> scene;  // index in the file; the file's default scene otherwise
        bool animate = true;
    };
    /// Adds the nodes, skins, lights, cameras and animations of one scene of the file.
    void instantiate(const Use& use);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace foveray::scene
