#pragma once

#include <span>
#include <vector>

#include "render/scene/mesh.h"

namespace foveray::scene {

struct DeformedVertices {
    std::vector<vec3> positions, normals;
    std::vector<vec4> tangents;  // empty if the primitive has none
};

/// Morph targets first, then linear blend skinning (glTF 2.0 sections 3.7.2.2 and 3.7.3). Empty spans:
/// without that. With joints the result is in world space. Normals go by the inverse transpose.
DeformedVertices deform(const Primitive& primitive, std::span<const mat4> joints,
                        std::span<const float> morph_weights);

}  // namespace foveray::scene
