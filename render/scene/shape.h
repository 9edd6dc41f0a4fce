#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/math.h"
#include "render/scene/blend.h"
#include "render/scene/csg.h"
#include "render/scene/ids.h"
#include "render/scene/mesh.h"
#include "render/scene/voxels.h"

namespace foveray::scene {

/// What a shader, rather than triangles, says the surface is. Object space; the node's transform places it.
enum class ShapeKind : std::uint8_t { Sphere, Box, OrientedBox, Plane, Csg, User, Julia, Mandelbulb, Blend, Voxels };

/// A number or vector that a kind of shape has, to be set and animated by its name.
struct ShapeParameter {
    std::string_view name;
    std::uint32_t width = 1;          // numbers, 1 to 4
    vec4 otherwise{0.0f};             // where the scene does not say
    float least = 0.0f, most = 0.0f;  // of each number
    bool rotation = false;            // a quaternion x, y, z, w of any length but zero
};

/// A kind of shape as the scene file names it. Adding one: docs/adding-a-primitive.md.
struct ShapeKindInfo {
    ShapeKind kind = ShapeKind::Sphere;
    std::string_view name;
    std::vector<ShapeParameter> parameters;
    /// Object space; null: the values do not tell (bounds_of does).
    Aabb (*bounds)(std::span<const float> values) = nullptr;
};

constexpr float smallest_shape = 1e-4f, largest_shape = 1e4f;  // metres

/// The quaternion in four values; the identity where they have no length (half way between opposite keys).
quat rotation_of(std::span<const float> xyzw);

std::span<const ShapeKindInfo> shape_kinds();
const ShapeKindInfo& shape_kind(ShapeKind kind);

struct Shape {
    std::string name;
    ShapeKind kind = ShapeKind::Sphere;
    MaterialId material = 0;
    std::vector<float> values;  // of the kind's parameters, one after the other
    bool animated = false;      // the values change with time; filled by SceneBuilder
    std::shared_ptr<const Voxels> voxels;  // of kind Voxels; shared by shapes of the same source
    std::string voxels_source;             // of kind Voxels
    CsgSolid solid;             // of kind Csg
    std::vector<BlendPart> blend_parts;  // of kind Blend
    UserShapeId user = 0;       // of kind User: its file in Scene::user_shapes
    Aabb user_bounds;           // of kind User
    bool user_time = false;     // of kind User: the last value stands for the session's time
};

/// The values where nothing is said of them.
std::vector<float> default_values(std::span<const ShapeParameter> parameters);
/// Where the parameter's numbers start among the values; empty: there is none of that name.
std::optional<std::uint32_t> parameter_offset(std::span<const ShapeParameter> parameters,
                                              std::string_view name);

/// Object-space bounds of the shape when its parameters have these values.
Aabb bounds_of(const Shape& shape, std::span<const float> values);

}  // namespace foveray::scene
