#include "render/gpu_blends.h"

#include <algorithm>

namespace foveray::render {
namespace {

static_assert(scene::most_blend_parts == shared::BLEND_MOST_PARTS);
static_assert(static_cast<std::uint32_t>(scene::BlendPrimitive::Box) == shared::BLEND_BOX &&
              static_cast<std::uint32_t>(scene::BlendPrimitive::Torus) == shared::BLEND_TORUS &&
              static_cast<std::uint32_t>(scene::BlendPrimitive::Capsule) == shared::BLEND_CAPSULE);
static_assert(static_cast<std::uint32_t>(scene::BlendOperation::Subtract) == shared::BLEND_SUBTRACT &&
              static_cast<std::uint32_t>(scene::BlendOperation::Intersect) == shared::BLEND_INTERSECT);

/// Sizes are those of the object: only what differs between a scale's axes stays in the matrix, which never
/// lengthens, so that a distance in the part's space is never too long in the object's.
shared::BlendPart packed(const scene::BlendPart& part) {
    scene::Transform object_from_part = part.object_from_part;
    vec3& scale = object_from_part.scale;
    const bool is_box = part.primitive == scene::BlendPrimitive::Box;
    const vec3 taken = is_box ? scale : vec3(std::min({scale.x, scale.y, scale.z}));
    scale /= taken;
    shared::BlendPart result{};
    result.part_from_object = glm::mat4x3(glm::inverse(glm::dmat4(to_matrix(object_from_part))));
    result.size = part.size * taken;
    result.kind = static_cast<std::uint32_t>(part.primitive);
    result.color = part.color;
    result.operation = static_cast<std::uint32_t>(part.operation);
    return result;
}

}  // namespace

GpuBlends::GpuBlends(gpu::Uploader& uploader, const scene::Scene& scene) {
    std::vector<shared::BlendPart> parts;
    for (const scene::Shape& shape : scene.shapes) {
        places_.push_back(
            {static_cast<std::uint32_t>(parts.size()), static_cast<std::uint32_t>(shape.blend_parts.size())});
        for (const scene::BlendPart& part : shape.blend_parts) parts.push_back(packed(part));
    }
    if (!parts.empty()) parts_ = uploader.buffer("blend parts", gpu::range_bytes(parts));
}

shared::BlendRecord GpuBlends::record(const shared::ShapeHeader& header, float smoothness,
                                      const scene::Aabb& bounds) const {
    const Place& place = places_[header.shape];
    return {.shape = header,
            .parts = parts_.address() + place.first * sizeof(shared::BlendPart),
            .part_count = place.count,
            .smoothness = smoothness,
            .bounds_min = bounds.min,
            .bounds_max = bounds.max};
}

}  // namespace foveray::render
