#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/math.h"
#include "base/time.h"
#include "render/scene/ids.h"

namespace foveray::scene {

struct Transform {
    vec3 translation{0.0f};
    quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    vec3 scale{1.0f};
};

mat4 to_matrix(const Transform& transform);

/// A while in session time: from `from` until just before `until`.
struct Presence {
    Nanoseconds from = 0, until = std::numeric_limits<Nanoseconds>::max();
};

/// A place in the tree. A node's parent always has a smaller id, so one pass in id order makes world
/// transforms.
struct Node {
    std::string name;
    std::optional<NodeId> parent;
    Transform local;             // parent_from_node, unless `matrix` is set
    std::optional<mat4> matrix;  // nodes given by a matrix are never animated
    std::optional<MeshId> mesh;
    std::optional<SkinId> skin;  // only with a mesh
    std::optional<LightId> light;
    std::optional<AreaLightId> area_light;
    std::optional<CameraId> camera;
    std::optional<ShapeId> shape;           // instead of a mesh
    std::vector<float> morph_weights;       // empty: the mesh's
    std::vector<Transform> mesh_instances;  // of the mesh or shape (EXT_mesh_gpu_instancing):
                                            // node_from_instance; empty: once, as is
    std::vector<Presence> present;  // when it and all below it are there; empty: always
};

struct Skin {
    std::string name;
    std::vector<NodeId> joints;
    std::vector<mat4> inverse_bind;  // joint_from_object, as many as joints
};

struct Camera {
    std::string name;
    float vertical_fov = 1.0f;  // radians; looks along -z of its node
    float aspect_ratio = 0.0f;  // width / height; 0: the picture's own
};

enum class Interpolation : std::uint8_t { Step, Linear, CubicSpline };
enum class AnimatedProperty : std::uint8_t {
    // Of a node.
    Translation,
    Rotation,
    Scale,
    Weights,
    ShapeValues,
    // Of a material.
    BaseColor,
    Alpha,
    Metallic,
    Roughness,
    Emissive,
    Transmission,
};

constexpr bool is_of_material(AnimatedProperty property) { return property >= AnimatedProperty::BaseColor; }

/// Keys of one property of one node (glTF 2.0 section 3.11), of a parameter of its shape, or of a material.
/// `values` holds, for each time, `width` floats (3, 4 as xyzw, 3, the number of morph targets, or as many as
/// the parameter or the material's value has), or 3 * width for CubicSpline: in-tangent, value, out-tangent.
struct AnimationChannel {
    NodeId node = 0;
    MaterialId material = 0;  // of a material's property, which no node has
    AnimatedProperty property = AnimatedProperty::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::uint32_t width = 3;
    std::uint32_t first_value = 0;  // of ShapeValues: where the parameter stands in Shape::values
    std::vector<float> times;       // seconds, strictly increasing
    std::vector<float> values;
};

struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;
    float duration = 0.0f;  // seconds, the last key; the animation loops; filled by SceneBuilder
};

}  // namespace foveray::scene
