#pragma once

#include "render/scene/scene.h"

namespace foveray::reference {

/// The texture at level 0 with the sampler's wrapping and magnification filter; `srgb`: red, green and blue
/// are decoded to linear before filtering.
vec4 sample_texture(const scene::Scene& scene, scene::TextureId texture, vec2 uv, bool srgb);

/// Of a point in a triangle: corner weights (1 - u - v, u, v).
template <typename T>
T interpolate(const std::vector<T>& values, const std::uint32_t* corners, double u, double v, T otherwise) {
    if (values.empty()) return otherwise;
    const auto w1 = static_cast<float>(u), w2 = static_cast<float>(v);
    return (1.0f - w1 - w2) * values[corners[0]] + w1 * values[corners[1]] + w2 * values[corners[2]];
}

/// Base colour and alpha: factor x texture x vertex colour (glTF 2.0 section 3.9.2), linear. Alpha is as it
/// comes, whatever the alpha mode.
vec4 base_color(const scene::Scene& scene, const scene::Primitive& primitive, const std::uint32_t* corners,
                double u, double v);

}  // namespace foveray::reference
