#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "render/gpu_mesh.h"

namespace foveray::render {

/// A mesh on the GPU with its levels of detail and what has been built of them.
class SharedMesh {
  public:
    /// `rigid`: drawn as it is, so in levels of detail; else it is only what deformed ones start from.
    SharedMesh(gpu::Uploader& uploader, const std::string& name, const scene::Mesh& mesh, bool rigid);

    const GpuMesh& mesh() const { return mesh_; }
    /// Of the mesh and of its coarser levels: object space, metres, the first 0. Empty: it has none.
    const std::vector<float>& level_errors() const { return level_errors_; }

    /// A level's structure, built before for geometries that are opaque or not; null: there is none.
    std::shared_ptr<gpu::BottomLevel> built(std::uint32_t level, const std::vector<bool>& opaque) const;
    void keep(std::uint32_t level, std::vector<bool> opaque, std::shared_ptr<gpu::BottomLevel> structure);

  private:
    SharedMesh(gpu::Uploader& uploader, const std::string& name, const scene::Mesh& mesh,
               const std::vector<scene::MeshLevel>& levels);

    GpuMesh mesh_;
    std::vector<float> level_errors_;
    std::map<std::pair<std::uint32_t, std::vector<bool>>, std::shared_ptr<gpu::BottomLevel>> built_;
};

/// Meshes that scenes have in common, which are neither uploaded nor built a second time. It keeps nothing
/// alive. One thread at a time.
class MeshStore {
  public:
    /// The same mesh for the same triangles and vertices, whatever their materials.
    std::shared_ptr<SharedMesh> get(gpu::Uploader& uploader, const std::string& name, const scene::Mesh& mesh,
                                    bool rigid);

  private:
    /// Of a mesh's contents: two independent sums of 64 bits.
    struct Key {
        std::array<std::uint64_t, 2> sum{};
        bool rigid = false;

        auto operator<=>(const Key&) const = default;
    };
    static Key key_of(const scene::Mesh& mesh, bool rigid);

    std::map<Key, std::weak_ptr<SharedMesh>> meshes_;
};

}  // namespace foveray::render
