#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <openxr/openxr.h>

#include "base/frame.h"

/// What controllers have: OpenXR 1.0, section 6.4, OpenXR 1.1, section 6.4, and XR_EXT_eye_gaze_interaction.
namespace foveray::simulator {

enum class InputKind { Boolean, Float, Vector2, Pose, Haptic };

/// One input or output of a device, such as /user/hand/left/input/trigger/value.
struct InputSource {
    std::string path;
    std::string user;       // /user/hand/left
    std::string component;  // /input/trigger/value
    InputKind kind = InputKind::Boolean;
    std::string_view feature;  // that brings it, as of Instance::has

    /// The path means it: its own, or its identifier's, such as .../trigger of .../trigger/value.
    bool answers_to(std::string_view path_text) const;
};

struct InteractionProfile {
    std::string path;
    std::string name;          // for people
    std::string_view feature;  // that brings it, as of Instance::has
    std::vector<InputSource> sources;

    /// The source that a suggested path means for an action: the source itself, or the fitting component of
    /// an identifier, such as .../trigger/value of .../trigger. nullptr when the kinds do not go together.
    const InputSource* find(std::string_view path_text, XrActionType type) const;
    /// It has sources of that user path.
    bool has_user(std::string_view user_path) const;
};

std::span<const InteractionProfile> interaction_profiles();
/// nullptr when there is none of that path.
const InteractionProfile* find_interaction_profile(std::string_view path);

inline constexpr std::string_view left_hand_path = "/user/hand/left";
inline constexpr std::string_view right_hand_path = "/user/hand/right";
inline constexpr std::string_view eyes_path = "/user/eyes_ext";
inline constexpr std::string_view user_paths[] = {left_hand_path, right_hand_path, "/user/head",
                                                  "/user/gamepad", "/user/treadmill", eyes_path};
/// A top level path of the core, or with `has_eyes` of XR_EXT_eye_gaze_interaction.
bool is_user_path(std::string_view path, bool has_eyes);
/// The source of that path and kind in the oldest profile that has it; nullptr when there is none.
const InputSource* find_source(std::string_view path, InputKind kind);

/// 0 or 1 of a hand's path.
std::optional<int> hand_of(std::string_view user_path);
/// A Boolean or Float source's value in x (0 or 1 for Boolean), a Vector2 source's in both.
vec2 input_value(const InputSource& source, const ControllerState& state);
/// "Left Hand Oculus Touch Trigger": the parts that `which` asks for.
std::string localized_name(const InteractionProfile& profile, const InputSource& source,
                           XrInputSourceLocalizedNameFlags which);

}  // namespace foveray::simulator
