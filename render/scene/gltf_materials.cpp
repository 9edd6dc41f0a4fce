#include "render/scene/gltf_materials.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "render/scene/gltf_values.h"

namespace foveray::scene {
namespace {

class MaterialReader {
  public:
    MaterialReader(SceneBuilder& builder, const GltfDocument& document)
        : builder_(builder), document_(document) {}

    Material read(std::size_t index);

  private:
    void read_optics(const Json& json, const std::string& place, Material& material);
    TextureUse texture_use(const Json& owner, const std::string& key, const std::string& owner_place);
    std::optional<TextureId> texture(std::size_t index);
    ImageId image(std::size_t index);
    Sampler sampler(std::size_t index) const;

    SceneBuilder& builder_;
    const GltfDocument& document_;
    std::map<std::size_t, std::optional<TextureId>> textures_;
    std::map<std::size_t, ImageId> images_;
};

Material MaterialReader::read(std::size_t index) {
    const Json& json = document_.json["materials"][index];
    const tinygltf::Material& parsed = document_.model.materials[index];
    const std::string place = "/materials/" + std::to_string(index);
    const Json pbr = json.value("pbrMetallicRoughness", Json::object());
    const std::string pbr_place = place + "/pbrMetallicRoughness";
    if (!pbr.is_object()) document_.fault(pbr_place, "must be an object");

    Material m;
    m.name = parsed.name;
    const auto base = numbers_at(document_, pbr, "baseColorFactor", pbr_place, {1, 1, 1, 1});
    m.base_color = {base[0], base[1], base[2], base[3]};
    m.metallic = number_at(document_, pbr, "metallicFactor", pbr_place, 1.0f);
    m.roughness = number_at(document_, pbr, "roughnessFactor", pbr_place, 1.0f);
    m.base_color_texture = texture_use(pbr, "baseColorTexture", pbr_place);
    m.metallic_roughness_texture = texture_use(pbr, "metallicRoughnessTexture", pbr_place);
    m.normal_texture = texture_use(json, "normalTexture", place);
    m.occlusion_texture = texture_use(json, "occlusionTexture", place);
    m.emissive_texture = texture_use(json, "emissiveTexture", place);
    if (m.normal_texture) {
        m.normal_scale = number_at(document_, json["normalTexture"], "scale", place + "/normalTexture", 1.0f);
    }
    if (m.occlusion_texture) {
        m.occlusion_strength =
            number_at(document_, json["occlusionTexture"], "strength", place + "/occlusionTexture", 1.0f);
    }

    const auto emissive = numbers_at(document_, json, "emissiveFactor", place, {0, 0, 0});
    m.emissive = {emissive[0], emissive[1], emissive[2]};
    const std::string strength = "KHR_materials_emissive_strength";
    if (const Json* extension = extension_of(json, strength)) {
        m.emissive *=
            number_at(document_, *extension, "emissiveStrength", place + "/extensions/" + strength, 1.0f);
    }

    if (parsed.alphaMode == "MASK") {
        m.alpha_mode = AlphaMode::Mask;
    } else if (parsed.alphaMode == "BLEND") {
        m.alpha_mode = AlphaMode::Blend;
    } else if (parsed.alphaMode != "OPAQUE") {
        document_.fault(place + "/alphaMode", "must be OPAQUE, MASK or BLEND");
    }
    m.alpha_cutoff = number_at(document_, json, "alphaCutoff", place, 0.5f);
    m.double_sided = parsed.doubleSided;
    m.unlit = extension_of(json, "KHR_materials_unlit") != nullptr;
    read_optics(json, place, m);
    return m;
}

void MaterialReader::read_optics(const Json& json, const std::string& place, Material& m) {
    const auto at = [&](const std::string& name) { return place + "/extensions/" + name; };
    const std::string transmission = "KHR_materials_transmission", volume = "KHR_materials_volume",
                      ior = "KHR_materials_ior";
    if (const Json* e = extension_of(json, transmission)) {
        m.transmission = number_at(document_, *e, "transmissionFactor", at(transmission), 0.0f);
        m.transmission_texture = texture_use(*e, "transmissionTexture", at(transmission));
    }
    if (const Json* e = extension_of(json, ior)) {
        m.ior = number_at(document_, *e, "ior", at(ior), 1.5f);
        if (m.ior != 0.0f && m.ior < 1.0f) document_.fault(at(ior) + "/ior", "must be 0 or at least 1");
    }
    if (const Json* e = extension_of(json, volume)) {
        m.solid = number_at(document_, *e, "thicknessFactor", at(volume), 0.0f) > 0.0f;
        const auto color = numbers_at(document_, *e, "attenuationColor", at(volume), {1, 1, 1});
        m.attenuation_color = {color[0], color[1], color[2]};
        m.attenuation_distance = number_at(document_, *e, "attenuationDistance", at(volume), 0.0f);
    }
}

TextureUse MaterialReader::texture_use(const Json& owner, const std::string& key,
                                       const std::string& owner_place) {
    if (!owner.contains(key)) return {};
    const Json& info = owner[key];
    const std::string place = owner_place + "/" + key;
    if (!info.is_object() || !info.contains("index"))
        document_.fault(place, "must be an object with an index");

    TextureUse use;
    use.texture = texture(info["index"].get<std::size_t>());
    float uv_set = number_at(document_, info, "texCoord", place, 0.0f);
    if (const Json* transform = extension_of(info, "KHR_texture_transform")) {
        const std::string here = place + "/extensions/KHR_texture_transform";
        const auto offset = numbers_at(document_, *transform, "offset", here, {0, 0});
        const auto scale = numbers_at(document_, *transform, "scale", here, {1, 1});
        use.offset = {offset[0], offset[1]};
        use.scale = {scale[0], scale[1]};
        use.rotation = number_at(document_, *transform, "rotation", here, 0.0f);
        uv_set = number_at(document_, *transform, "texCoord", here, uv_set);
    }
    if (uv_set != 0.0f && uv_set != 1.0f) {
        builder_.warn(document_.file.string() + ": " + place +
                      ": only texture coordinate sets 0 and 1 are supported; this texture is left out");
        return {};
    }
    use.uv_set = static_cast<std::uint32_t>(uv_set);
    return use;
}

std::optional<TextureId> MaterialReader::texture(std::size_t index) {
    if (const auto known = textures_.find(index); known != textures_.end()) return known->second;
    const tinygltf::Texture& parsed = document_.model.textures[index];
    std::optional<TextureId> id;
    if (parsed.source < 0) {
        builder_.warn(document_.file.string() + ": /textures/" + std::to_string(index) +
                      ": has no image in a format that every glTF reader knows; it is left out");
    } else {
        Texture texture;
        texture.image = image(static_cast<std::size_t>(parsed.source));
        if (parsed.sampler >= 0) texture.sampler = sampler(static_cast<std::size_t>(parsed.sampler));
        id = builder_.add(texture);
    }
    textures_[index] = id;
    return id;
}

ImageId MaterialReader::image(std::size_t index) {
    if (const auto known = images_.find(index); known != images_.end()) return known->second;
    const Json& json = document_.json["images"][index];
    const std::string place = "/images/" + std::to_string(index);
    const std::string uri = json.value("uri", std::string());
    std::string name = json.value("name", std::string());
    const bool is_data = uri.starts_with("data:");
    if (name.empty()) name = uri.empty() || is_data ? place : uri;

    const std::string where =
        document_.file.string() + ": " + place + (uri.empty() || is_data ? "" : " (" + uri + ")");
    Image pixels;
    if (!uri.empty()) {
        pixels = decode_image(read_uri(document_, uri, place + "/uri"), 4, where);
    } else if (json.contains("bufferView")) {
        pixels = decode_image(view_bytes(document_, json["bufferView"].get<std::size_t>()), 4, where);
    } else {
        document_.fault(place, "has neither a uri nor a bufferView");
    }
    const ImageId id = builder_.add(TextureImage{std::move(name), std::move(pixels)});
    images_[index] = id;
    return id;
}

Sampler MaterialReader::sampler(std::size_t index) const {
    const tinygltf::Sampler& parsed = document_.model.samplers[index];
    const auto wrap = [&](int mode) {
        switch (mode) {
            case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
                return Wrap::ClampToEdge;
            case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
                return Wrap::MirroredRepeat;
            case TINYGLTF_TEXTURE_WRAP_REPEAT:
                return Wrap::Repeat;
            default:
                document_.fault("/samplers/" + std::to_string(index), "has an unknown wrap mode");
        }
    };
    Sampler s;
    s.wrap_u = wrap(parsed.wrapS);
    s.wrap_v = wrap(parsed.wrapT);
    if (parsed.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) s.mag = Filter::Nearest;
    switch (parsed.minFilter) {
        case TINYGLTF_TEXTURE_FILTER_NEAREST:
            s.min = Filter::Nearest, s.mip = MipFilter::None;
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR:
            s.min = Filter::Linear, s.mip = MipFilter::None;
            break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
            s.min = Filter::Nearest, s.mip = MipFilter::Nearest;
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
            s.min = Filter::Linear, s.mip = MipFilter::Nearest;
            break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
            s.min = Filter::Nearest, s.mip = MipFilter::Linear;
            break;
        default:
            break;
    }
    return s;
}

}  // namespace

std::vector<MaterialId> add_materials(SceneBuilder& builder, const GltfDocument& document) {
    MaterialReader reader(builder, document);
    std::vector<MaterialId> ids;
    for (std::size_t i = 0; i < document.model.materials.size(); ++i)
        ids.push_back(builder.add(reader.read(i)));
    return ids;
}

}  // namespace foveray::scene
