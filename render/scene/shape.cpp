#include "render/scene/shape.h"

#include <algorithm>

namespace foveray::scene {
namespace {

constexpr float smallest = 1e-4f, largest = 1e4f;  // metres

Aabb box_of(vec3 half_size) { return {-half_size, half_size}; }

const std::vector<ShapeKindInfo>& table() {
    static const std::vector<ShapeKindInfo> kinds = {
        {ShapeKind::Sphere,
         "sphere",
         {{"radius", 1, vec4(0.5f), smallest, largest}},
         [](std::span<const float> v) { return box_of(vec3(v[0])); }},
        {ShapeKind::Box,
         "box",
         {{"half_size", 3, vec4(0.5f), smallest, largest}},
         [](std::span<const float> v) {
             return box_of({v[0], v[1], v[2]});
         }},
    };
    return kinds;
}

}  // namespace

std::span<const ShapeKindInfo> shape_kinds() { return table(); }

const ShapeKindInfo& shape_kind(ShapeKind kind) {
    return *std::ranges::find(table(), kind, &ShapeKindInfo::kind);
}

std::vector<float> default_values(std::span<const ShapeParameter> parameters) {
    std::vector<float> values;
    for (const ShapeParameter& p : parameters) {
        for (std::uint32_t i = 0; i < p.width; ++i) values.push_back(p.otherwise[static_cast<int>(i)]);
    }
    return values;
}

std::optional<std::uint32_t> parameter_offset(std::span<const ShapeParameter> parameters,
                                              std::string_view name) {
    std::uint32_t offset = 0;
    for (const ShapeParameter& p : parameters) {
        if (p.name == name) return offset;
        offset += p.width;
    }
    return std::nullopt;
}

Aabb bounds_of(const Shape& shape, std::span<const float> values) {
    return shape_kind(shape.kind).bounds(values);
}

}  // namespace foveray::scene
