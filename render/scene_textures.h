#pragma once

#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "render/gpu/commands.h"
#include "render/gpu/texture_table.h"
#include "render/scene/scene.h"
#include "shaders/shared/scene.h"

namespace foveray::render {

/// A material as shaders read it, but for its textures, which stay as they are in `into`.
void pack_values(const scene::Material& material, shared::Material& into);

/// A scene's images on the GPU, with all their levels, and its textures in the texture table. Images that no
/// material uses are left out; one that serves both as colour and as data exists in both formats.
class SceneTextures {
  public:
    SceneTextures(const gpu::Device& device, gpu::TextureTable& table, gpu::Uploader& uploader,
                  const scene::Scene& scene);
    ~SceneTextures() { release(); }
    SceneTextures(const SceneTextures&) = delete;
    SceneTextures& operator=(const SceneTextures&) = delete;

    /// The scene's materials in their order.
    const std::vector<shared::Material>& materials() const { return materials_; }

  private:
    void add_materials(gpu::Uploader& uploader, const scene::Scene& scene);
    void release();
    enum class Content { Color, Data };  // Color: sRGB

    const gpu::Image& image(gpu::Uploader& uploader, const scene::Scene& scene, const scene::Texture& texture,
                            Content content);
    std::uint32_t texture(gpu::Uploader& uploader, const scene::Scene& scene, scene::TextureId id,
                          Content content);
    shared::TextureUse use(gpu::Uploader& uploader, const scene::Scene& scene, const scene::TextureUse& use,
                           Content content);

    const gpu::Device& device_;
    gpu::TextureTable& table_;
    /// What lies beyond an image's edges is part of its levels.
    std::map<std::tuple<scene::ImageId, Content, scene::Wrap, scene::Wrap>, gpu::Image> images_;
    std::map<std::pair<scene::TextureId, Content>, std::uint32_t> textures_;  // index in the table
    std::vector<shared::Material> materials_;
};

}  // namespace foveray::render
