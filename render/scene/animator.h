#pragma once

#include <span>
#include <vector>

#include "base/time.h"
#include "render/scene/scene.h"

namespace foveray::scene {

/// The channel's value at `seconds`, `width` floats; before the first and after the last key it is constant.
/// Rotations come out normalised (linear: shortest arc slerp), as glTF 2.0 appendix C has it.
std::vector<float> sample(const AnimationChannel& channel, float seconds);

struct InstanceState {
    mat4 world_from_object{1.0f};  // skinned meshes: the identity, their joints place them in the world
    mat4 previous_world_from_object{1.0f};
    bool moved = false;   // the two differ
    bool present = true;  // else no ray meets it. What has just come has not moved
};

struct DeformationState {
    std::vector<mat4> joints;  // world_from_object for each joint of the skin; empty without a skin
    std::vector<mat4> previous_joints;
    std::vector<float> morph_weights;  // empty without morph targets
    std::vector<float> previous_morph_weights;
    bool changed = false;  // vertices must be computed anew: always in the first frame
};

struct ShapeState {
    std::vector<float> values;  // as Shape::values
    Aabb bounds;                // object space, at these values
    bool changed =
        false;  // the values are not the last frame's: of animated shapes always in the first frame
};

/// A material that is not as Scene has it.
struct MaterialState {
    MaterialId material = 0;
    Material values;       // its textures are the scene's
    bool changed = false;  // not the last frame's; in the first frame always
};

/// One frame's state. Vectors are parallel to those of Scene. Lights are those that are present, in the order
/// of their nodes.
struct SceneChanges {
    Nanoseconds time = 0;
    std::vector<mat4> world_from_node, previous_world_from_node;
    std::vector<InstanceState> instances;
    std::vector<InstanceState> shape_instances;
    std::vector<DeformationState> deformations;
    std::vector<ShapeState> shapes;
    std::vector<PlacedLight> lights;
    std::vector<PlacedAreaLight> area_lights;
    std::vector<MaterialState> materials;  // those that are animated
    bool transforms_changed =
        false;  // some instance moved, came or went since the last frame; always in the first frame
};

/// Plays all animations of a scene in a loop by session time. Depends on nothing but the times given.
class SceneAnimator {
  public:
    /// The scene must outlive the animator.
    explicit SceneAnimator(const Scene& scene);

    /// The state at `time`, counted from the start of the session; "previous" is the state of the last call
    /// (of this one, in the first call). The reference is good until the next call.
    const SceneChanges& advance(Nanoseconds time);

  private:
    const Scene* scene_;
    SceneChanges state_;
    std::vector<std::uint8_t> present_;  // by node
    bool started_ = false;
};

}  // namespace foveray::scene
