#pragma once

#include <optional>
#include <string>

#include "base/image.h"
#include "base/math.h"
#include "render/scene/ids.h"

namespace foveray::scene {

struct TextureImage {
    std::string name;
    Image pixels;  // RGBA, 8 bits; the use decides whether the colours are sRGB or data
};

enum class Filter : std::uint8_t { Nearest, Linear };
enum class MipFilter : std::uint8_t { None, Nearest, Linear };
enum class Wrap : std::uint8_t { Repeat, MirroredRepeat, ClampToEdge };

struct Sampler {
    Filter mag = Filter::Linear;
    Filter min = Filter::Linear;
    MipFilter mip = MipFilter::Linear;
    Wrap wrap_u = Wrap::Repeat;
    Wrap wrap_v = Wrap::Repeat;

    bool operator==(const Sampler&) const = default;
};

struct Texture {
    ImageId image = 0;
    Sampler sampler;
};

/// How a material uses a texture. The same texture or image may serve as colour (sRGB) in one use and as data
/// (linear) in another: base colour and emissive are colour, the rest is data. UV (0, 0) is the top left
/// corner.
struct TextureUse {
    std::optional<TextureId> texture;
    std::uint32_t uv_set = 0;  // 0 or 1
    vec2 offset{0.0f};         // KHR_texture_transform: uv' = offset + rotation * scale * uv
    float rotation = 0.0f;     // radians, counter-clockwise as the extension defines it
    vec2 scale{1.0f};

    explicit operator bool() const { return texture.has_value(); }
    bool operator==(const TextureUse&) const = default;
};

/// transformed uv = vec2(uv_matrix(use) * vec3(uv, 1)), as KHR_texture_transform gives it.
mat3 uv_matrix(const TextureUse& use);

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

/// glTF 2.0 metallic-roughness (section 3.9); textures multiply the factors.
struct Material {
    std::string name;
    vec4 base_color{1.0f};  // linear, with alpha
    float metallic = 1.0f;
    float roughness = 1.0f;  // perceptual; alpha = roughness²
    vec3 emissive{0.0f};     // radiance, KHR_materials_emissive_strength multiplied in
    float normal_scale = 1.0f;
    float occlusion_strength = 1.0f;
    AlphaMode alpha_mode = AlphaMode::Opaque;
    float alpha_cutoff = 0.5f;  // Mask only
    bool double_sided = false;
    bool unlit = false;  // KHR_materials_unlit: base colour is the radiance

    float transmission = 0.0f;     // KHR_materials_transmission: share of the light that is not reflected
    float ior = 1.5f;              // KHR_materials_ior
    bool solid = false;            // KHR_materials_volume with a thickness: the mesh encloses the material
    vec3 attenuation_color{1.0f};  // of white light after attenuation_distance in it
    float attenuation_distance = 0.0f;  // metres; 0: it takes nothing away
    bool becomes_transmissive = false;  // an animation takes `transmission` above 0; filled by SceneBuilder

    TextureUse base_color_texture;          // sRGB + alpha
    TextureUse metallic_roughness_texture;  // G roughness, B metallic
    TextureUse normal_texture;              // tangent space
    TextureUse occlusion_texture;           // R
    TextureUse emissive_texture;            // sRGB
    TextureUse transmission_texture;        // R
};

/// All light ends at it, at any time.
bool is_opaque(const Material& material);

}  // namespace foveray::scene
