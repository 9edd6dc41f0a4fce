#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/mesh.h"
#include "render/scene/node.h"

namespace foveray::scene {

/// Centred at the origin; torus and capsule have the y axis as theirs.
enum class BlendPrimitive : std::uint8_t { Sphere, Box, Torus, Capsule };
/// What a part does to what those before it made.
enum class BlendOperation : std::uint8_t { Union, Subtract, Intersect };

struct BlendPart {
    BlendPrimitive primitive = BlendPrimitive::Sphere;
    BlendOperation operation = BlendOperation::Union;  // of the first part
    /// Sphere: radius. Box: half-sizes. Torus: radius of the ring, of the tube. Capsule: radius, half-height
    /// between the centres of its ends.
    vec3 size{0.5f, 0.0f, 0.0f};
    Transform object_from_part;
    vec3 color{1.0f};  // multiplies the material's
};

constexpr std::size_t most_blend_parts = 16;

/// Object-space bounds of the parts, joined over a width of `smoothness`.
Aabb bounds_of(std::span<const BlendPart> parts, float smoothness);

}  // namespace foveray::scene
