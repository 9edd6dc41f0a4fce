#include "render/scene/material.h"

#include <cmath>

namespace foveray::scene {

mat3 uv_matrix(const TextureUse& use) {
    const float c = std::cos(use.rotation), s = std::sin(use.rotation);
    // v grows downwards, so counter-clockwise to the eye is clockwise in (u, v).
    return {vec3(c * use.scale.x, -s * use.scale.x, 0.0f), vec3(s * use.scale.y, c * use.scale.y, 0.0f),
            vec3(use.offset, 1.0f)};
}

bool is_opaque(const Material& material) {
    return material.alpha_mode == AlphaMode::Opaque && material.transmission == 0.0f &&
           !material.becomes_transmissive;
}

}  // namespace foveray::scene
