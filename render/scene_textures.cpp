#include "render/scene_textures.h"

#include <span>

#include "render/mip_levels.h"

namespace foveray::render {
namespace {

vk::SamplerAddressMode address_mode(scene::Wrap wrap) {
    switch (wrap) {
        case scene::Wrap::Repeat:
            return vk::SamplerAddressMode::eRepeat;
        case scene::Wrap::MirroredRepeat:
            return vk::SamplerAddressMode::eMirroredRepeat;
        case scene::Wrap::ClampToEdge:
            return vk::SamplerAddressMode::eClampToEdge;
    }
    return vk::SamplerAddressMode::eRepeat;
}

vk::Filter filter(scene::Filter value) {
    return value == scene::Filter::Nearest ? vk::Filter::eNearest : vk::Filter::eLinear;
}

gpu::SamplerInfo sampler_info(const scene::Sampler& sampler) {
    gpu::SamplerInfo info;
    info.mag = filter(sampler.mag);
    info.min = filter(sampler.min);
    info.use_mips = sampler.mip != scene::MipFilter::None;
    info.mip = sampler.mip == scene::MipFilter::Linear ? vk::SamplerMipmapMode::eLinear
                                                       : vk::SamplerMipmapMode::eNearest;
    info.u = address_mode(sampler.wrap_u);
    info.v = address_mode(sampler.wrap_v);
    return info;
}

std::uint32_t flags(const scene::Material& material) {
    std::uint32_t flags = 0;
    if (material.alpha_mode == scene::AlphaMode::Mask) flags |= shared::MATERIAL_ALPHA_MASK;
    if (material.alpha_mode == scene::AlphaMode::Blend) flags |= shared::MATERIAL_ALPHA_BLEND;
    if (material.double_sided) flags |= shared::MATERIAL_DOUBLE_SIDED;
    if (material.unlit) flags |= shared::MATERIAL_UNLIT;
    if (material.transmission > 0.0f) flags |= shared::MATERIAL_TRANSMISSIVE;
    if (material.transmission > 0.0f && material.solid) flags |= shared::MATERIAL_SOLID;
    return flags;
}

/// Per metre: what is left after d metres is exp(-attenuation * d).
vec3 attenuation(const scene::Material& material) {
    if (!(material.attenuation_distance > 0.0f)) return vec3(0.0f);
    return -glm::log(glm::clamp(material.attenuation_color, 1e-6f, 1.0f)) / material.attenuation_distance;
}

}  // namespace

void pack_values(const scene::Material& m, shared::Material& into) {
    into.base_color = m.base_color;
    into.emissive = m.emissive;
    into.metallic = m.metallic;
    into.roughness = m.roughness;
    into.normal_scale = m.normal_scale;
    into.occlusion_strength = m.occlusion_strength;
    into.alpha_cutoff = m.alpha_cutoff;
    into.flags = flags(m);
    into.transmission = m.transmission;
    into.ior = m.ior == 0.0f ? 1e6f : m.ior;  // the extension's 0 stands for infinity
    into.attenuation = attenuation(m);
}

SceneTextures::SceneTextures(const gpu::Device& device, gpu::TextureTable& table, gpu::Uploader& uploader,
                             const scene::Scene& scene)
    : device_(device), table_(table) {
    try {
        add_materials(uploader, scene);
    } catch (...) {
        release();  // a destructor is not run for what was not made
        throw;
    }
}

void SceneTextures::add_materials(gpu::Uploader& uploader, const scene::Scene& scene) {
    for (const scene::Material& m : scene.materials) {
        const auto place = [&](const scene::TextureUse& u, Content content) {
            return use(uploader, scene, u, content);
        };
        shared::Material material{};
        pack_values(m, material);
        material.base_color_texture = place(m.base_color_texture, Content::Color);
        material.metallic_roughness_texture = place(m.metallic_roughness_texture, Content::Data);
        material.normal_texture = place(m.normal_texture, Content::Data);
        material.occlusion_texture = place(m.occlusion_texture, Content::Data);
        material.emissive_texture = place(m.emissive_texture, Content::Color);
        material.transmission_texture = place(m.transmission_texture, Content::Data);
        materials_.push_back(material);
    }
}

void SceneTextures::release() {
    for (const auto& [key, index] : textures_) table_.remove(index);
}

const gpu::Image& SceneTextures::image(gpu::Uploader& uploader, const scene::Scene& scene,
                                       const scene::Texture& texture, Content content) {
    const scene::Wrap u = texture.sampler.wrap_u, v = texture.sampler.wrap_v;
    const std::tuple key(texture.image, content, u, v);
    const auto it = images_.find(key);
    if (it != images_.end()) return it->second;
    const scene::TextureImage& source = scene.images[texture.image];
    gpu::ImageInfo info;
    info.extent = vk::Extent2D(source.pixels.width, source.pixels.height);
    info.format = content == Content::Color ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm;
    info.mip_levels = mip_level_count(source.pixels.width, source.pixels.height);
    info.usage = vk::ImageUsageFlagBits::eSampled;
    const std::string name = "image " + std::to_string(texture.image) + " " + source.name;
    const std::vector<std::uint8_t> texels = mip_levels(source.pixels, content == Content::Color, u, v);
    return images_.emplace(key, uploader.image(name, info, gpu::range_bytes(texels), info.mip_levels))
        .first->second;
}

std::uint32_t SceneTextures::texture(gpu::Uploader& uploader, const scene::Scene& scene, scene::TextureId id,
                                     Content content) {
    const auto it = textures_.find({id, content});
    if (it != textures_.end()) return it->second;
    const scene::Texture& source = scene.textures[id];
    const std::uint32_t index =
        table_.add(image(uploader, scene, source, content).view(), sampler_info(source.sampler));
    textures_.emplace(std::pair(id, content), index);
    return index;
}

shared::TextureUse SceneTextures::use(gpu::Uploader& uploader, const scene::Scene& scene,
                                      const scene::TextureUse& use, Content content) {
    shared::TextureUse result{};
    result.texture = use ? texture(uploader, scene, *use.texture, content) : shared::NO_TEXTURE;
    result.uv_set = use.uv_set;
    const mat3 matrix = scene::uv_matrix(use);
    result.u_axis = vec2(matrix[0]);
    result.v_axis = vec2(matrix[1]);
    result.offset = vec2(matrix[2]);
    return result;
}

}  // namespace foveray::render
