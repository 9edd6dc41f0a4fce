#include "render/scene/shape.h"

#include <algorithm>

#include "render/scene/fractal.h"

namespace foveray::scene {
namespace {

constexpr float smallest = smallest_shape, largest = largest_shape;

Aabb box_of(vec3 half_size) { return {-half_size, half_size}; }

Aabb plane_bounds(std::span<const float> v) {
    return box_of({v[0], 1e-3f * std::max(v[0], v[1]), v[1]});  // some thickness, so that no ray slips past
}

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
        {ShapeKind::OrientedBox,
         "oriented_box",
         {{"half_size", 3, vec4(0.5f), smallest, largest},
          {"orientation", 4, vec4(0, 0, 0, 1), -1.0f, 1.0f, true}},
         [](std::span<const float> v) {
             return transformed(box_of({v[0], v[1], v[2]}), glm::mat4_cast(rotation_of(v.subspan(3))));
         }},
        {ShapeKind::Plane,
         "plane",
         {{"half_size", 2, vec4(0.5f), smallest, largest},
          {"checker_size", 1, vec4(0.0f), 0.0f, largest},
          {"checker_color", 3, vec4(0.0f), 0.0f, 1.0f}},
         plane_bounds},
        {ShapeKind::Julia, "julia", julia_parameters(), julia_bounds},
        {ShapeKind::Mandelbulb, "mandelbulb", mandelbulb_parameters(), mandelbulb_bounds},
        {ShapeKind::Voxels, "voxels", {}, nullptr},
        {ShapeKind::Blend, "blend", {{"smoothness", 1, vec4(0.1f), 0.0f, largest}}, nullptr},
        {ShapeKind::Csg, "csg", {}, nullptr},
        {ShapeKind::User, "user", {}, nullptr},  // its file tells the parameters
    };
    return kinds;
}

}  // namespace

quat rotation_of(std::span<const float> v) {
    const quat q(v[3], v[0], v[1], v[2]);
    const float length = glm::length(q);
    return length > 1e-6f ? q / length : quat(1.0f, 0.0f, 0.0f, 0.0f);
}

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
    if (shape.kind == ShapeKind::Voxels) return shape.voxels->bounds();
    if (shape.kind == ShapeKind::Csg) return bounds_of(shape.solid);
    if (shape.kind == ShapeKind::Blend) return bounds_of(shape.blend_parts, values[0]);
    if (shape.kind == ShapeKind::User) return shape.user_bounds;
    return shape_kind(shape.kind).bounds(values);
}

}  // namespace foveray::scene
