#include "render/reference/surface.h"

#include <cmath>

namespace foveray::reference {
namespace {

int wrap(int i, int size, scene::Wrap mode) {
    switch (mode) {
        case scene::Wrap::ClampToEdge:
            return std::min(std::max(i, 0), size - 1);
        case scene::Wrap::MirroredRepeat: {
            const int period = ((i % (2 * size)) + 2 * size) % (2 * size);
            return period < size ? period : 2 * size - 1 - period;
        }
        case scene::Wrap::Repeat:
            break;
    }
    return ((i % size) + size) % size;
}

}  // namespace

vec4 sample_texture(const scene::Scene& scene, scene::TextureId id, vec2 uv, bool srgb) {
    const scene::Texture& texture = scene.textures[id];
    const Image& image = scene.images[texture.image].pixels;
    const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
    const auto texel = [&](int x, int y) {
        const std::uint8_t* p = image.at(static_cast<std::uint32_t>(wrap(x, width, texture.sampler.wrap_u)),
                                         static_cast<std::uint32_t>(wrap(y, height, texture.sampler.wrap_v)));
        vec4 color = vec4(p[0], p[1], p[2], p[3]) / 255.0f;
        for (int c = 0; srgb && c < 3; ++c) color[c] = linear_from_srgb(color[c]);
        return color;
    };
    const vec2 at = uv * vec2(width, height);
    if (texture.sampler.mag == scene::Filter::Nearest) {
        return texel(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
    }
    const vec2 corner = glm::floor(at - 0.5f), f = at - 0.5f - corner;
    const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), f.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), f.x), f.y);
}

vec4 base_color(const scene::Scene& scene, const scene::Primitive& primitive, const std::uint32_t* corners,
                double u, double v) {
    const scene::Material& material = scene.materials[primitive.material];
    vec4 color = material.base_color * interpolate(primitive.colors, corners, u, v, vec4(1.0f));
    if (const scene::TextureUse& use = material.base_color_texture) {
        const std::vector<vec2>& uvs = use.uv_set == 0 ? primitive.uv0 : primitive.uv1;
        const vec2 uv = interpolate(uvs, corners, u, v, vec2(0.0f));
        color *= sample_texture(scene, *use.texture, vec2(scene::uv_matrix(use) * vec3(uv, 1.0f)), true);
    }
    return color;
}

}  // namespace foveray::reference
