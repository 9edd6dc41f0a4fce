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
    Aabb bounds;
    float unions = -1.0f;
    for (const BlendPart& part : parts) {
        if (part.operation != BlendOperation::Union) continue;
        const vec3 half_size = half_size_of(part);
        bounds.add(transformed({-half_size, half_size}, to_matrix(part.object_from_part)));
        unions += 1.0f;
    }
    // A smooth union takes at most a quarter of the width off the distance, and many not more than all of it.
    const float swelling = smoothness * std::min(0.25f * unions, 1.0f);
    return {bounds.min - swelling, bounds.max + swelling};
}

}  // namespace foveray::scene
