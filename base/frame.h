#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/gaze.h"
#include "base/math.h"
#include "base/time.h"
#include "base/view.h"

namespace foveray {

/// What the headset does with the pixels that we leave open.
enum class BlendMode { Opaque, Additive, AlphaBlend };

struct ControllerState {
    bool valid = false;  // the pose is tracked
    Pose stage_from_grip;
    Pose stage_from_aim;
    float trigger = 0.0f;  // 0 released, 1 pulled
    float squeeze = 0.0f;
    vec2 thumbstick{0.0f};
    bool primary_button = false;    // A or X
    bool secondary_button = false;  // B or Y
};

/// One frame as the headset asks for it: plain data, everything in stage space.
struct Frame {
    std::uint64_t index = 0;       // counts from 0 in a session
    Nanoseconds display_time = 0;  // on the runtime's clock
    Nanoseconds time = 0;  // since the session's first frame: the clock of scene, camera and session files
    Nanoseconds period = 0;
    bool should_render = false;
    std::vector<View> views;  // left context, right context[, left focus, right focus]
    bool head_valid = false;  // the headset knows its pose
    Pose stage_from_head;     // the last one known
    bool head_position_tracked = true, head_orientation_tracked = true;  // measured, not guessed
    bool has_eye_tracking = false;
    GazeSample gaze;                             // in stage space
    std::array<ControllerState, 2> controllers;  // left, right
    BlendMode blend = BlendMode::Opaque;
};

/// A triangle mesh over the pixels of a view that its wearer cannot see. z = -1 plane of the eye's frame.
struct HiddenMesh {
    std::vector<vec2> vertices;
    std::vector<std::uint32_t> indices;
    std::uint64_t version = 0;  // changes when the mesh does
};

}  // namespace foveray
