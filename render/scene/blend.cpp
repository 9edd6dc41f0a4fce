#include "render/scene/blend.h"

#include <algorithm>

namespace foveray::scene {
namespace {

vec3 half_size_of(const BlendPart& part) {
    switch (part.primitive) {
        case BlendPrimitive::Box:
            return part.size;
        case BlendPrimitive::Torus:
            return {part.size.x + part.size.y, part.size.y, part.size.x + part.size.y};
        case BlendPrimitive::Capsule:
            return {part.size.x, part.size.x + part.size.y, part.size.x};
        case BlendPrimitive::Sphere:
            break;
    }
    return vec3(part.size.x);
}

}  // namespace

Aabb bounds_of(std::span<const BlendPart> parts, float smoothness) {
    const auto unions = std::ranges::count(parts, BlendOperation::Union, &BlendPart::operation) - 1;
    // A smooth union takes at most a quarter of the width off the distance, and many not more than all of it.
    const float swelling = smoothness * std::min(0.25f * static_cast<float>(unions), 1.0f);
    Aabb bounds;
    for (const BlendPart& part : parts) {
        if (part.operation != BlendOperation::Union) continue;
        // Distances to what is no box are those in its own space times its least scale: it swells more along
        // the other axes.
        const vec3 scale = part.object_from_part.scale;
        const bool is_box = part.primitive == BlendPrimitive::Box;
        const vec3 taken = is_box ? scale : vec3(std::min({scale.x, scale.y, scale.z}));
        const vec3 half_size = half_size_of(part) + swelling / taken;
        bounds.add(transformed({-half_size, half_size}, to_matrix(part.object_from_part)));
    }
    return bounds;
}

}  // namespace foveray::scene
