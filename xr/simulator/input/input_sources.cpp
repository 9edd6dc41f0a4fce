#include "xr/simulator/input/input_sources.h"

#include <algorithm>
#include <cctype>

#include "xr/simulator/api/openxr_1_1.h"

namespace foveray::simulator {
namespace {

// What controllers of a family share.
#define FOVERAY_TOUCH                                                                                      \
    "</input/x/click </input/x/touch </input/y/click </input/y/touch </input/menu/click >/input/a/click "  \
    ">/input/a/touch >/input/b/click >/input/b/touch >/input/system/click /input/squeeze/value "           \
    "/input/trigger/value /input/trigger/touch /input/thumbstick /input/thumbstick/x /input/thumbstick/y " \
    "/input/thumbstick/click /input/thumbstick/touch /input/grip/pose /input/aim/pose /output/haptic"
#define FOVERAY_PROXIMITY " /input/trigger/proximity /input/thumb_resting_surfaces/proximity"
#define FOVERAY_PICO                                                                                        \
    "</input/x/click </input/x/touch </input/y/click </input/y/touch >/input/a/click >/input/a/touch "      \
    ">/input/b/click >/input/b/touch /input/system/click /input/squeeze/click /input/squeeze/value "        \
    "/input/trigger/click /input/trigger/touch /input/trigger/value /input/thumbstick /input/thumbstick/x " \
    "/input/thumbstick/y /input/thumbstick/click /input/thumbstick/touch /input/grip/pose /input/aim/pose " \
    "/output/haptic"
#define FOVERAY_VIVE                                                                                         \
    "</input/x/click </input/y/click </input/menu/click >/input/a/click >/input/b/click "                    \
    ">/input/system/click /input/squeeze/click /input/trigger/click /input/trigger/value /input/thumbstick " \
    "/input/thumbstick/x /input/thumbstick/y /input/thumbstick/click /input/thumbstick/touch "               \
    "/input/grip/pose /input/aim/pose /output/haptic"

struct ProfileText {
    std::string_view path, name, feature, users, components;
};

/// Components for both hands, or for one where "<" (left) or ">" (right) stands before them; those with "+"
/// came with OpenXR 1.1. Hands with a grip have a grip surface, too.
constexpr ProfileText profile_texts[] = {
    {"khr/simple_controller", "Simple Controller", "", "/user/hand/left /user/hand/right",
     "/input/select/click /input/menu/click /input/grip/pose /input/aim/pose /output/haptic"},
    {"google/daydream_controller", "Daydream Controller", "", "/user/hand/left /user/hand/right",
     "/input/select/click /input/trackpad /input/trackpad/x /input/trackpad/y /input/trackpad/click "
     "/input/trackpad/touch /input/grip/pose /input/aim/pose"},
    {"htc/vive_controller", "Vive Controller", "", "/user/hand/left /user/hand/right",
     "/input/system/click /input/squeeze/click /input/menu/click /input/trigger/click /input/trigger/value "
     "/input/trackpad /input/trackpad/x /input/trackpad/y /input/trackpad/click /input/trackpad/touch "
     "/input/grip/pose /input/aim/pose /output/haptic"},
    {"htc/vive_pro", "Vive Pro", "", "/user/head",
     "/input/system/click /input/volume_up/click /input/volume_down/click /input/mute_mic/click"},
    {"microsoft/motion_controller", "Mixed Reality Motion Controller", "", "/user/hand/left /user/hand/right",
     "/input/menu/click /input/squeeze/click /input/trigger/value /input/thumbstick /input/thumbstick/x "
     "/input/thumbstick/y /input/thumbstick/click /input/trackpad /input/trackpad/x /input/trackpad/y "
     "/input/trackpad/click /input/trackpad/touch /input/grip/pose /input/aim/pose /output/haptic"},
    {"microsoft/xbox_controller", "Xbox Controller", "", "/user/gamepad",
     "/input/menu/click /input/view/click /input/a/click /input/b/click /input/x/click /input/y/click "
     "/input/dpad_down/click /input/dpad_right/click /input/dpad_up/click /input/dpad_left/click "
     "/input/shoulder_left/click /input/shoulder_right/click /input/thumbstick_left/click "
     "/input/thumbstick_right/click /input/trigger_left/value /input/trigger_right/value "
     "/input/thumbstick_left /input/thumbstick_left/x /input/thumbstick_left/y /input/thumbstick_right "
     "/input/thumbstick_right/x /input/thumbstick_right/y /output/haptic_left /output/haptic_right "
     "/output/haptic_left_trigger /output/haptic_right_trigger"},
    {"oculus/go_controller", "Oculus Go Controller", "", "/user/hand/left /user/hand/right",
     "/input/system/click /input/trigger/click /input/back/click /input/trackpad /input/trackpad/x "
     "/input/trackpad/y /input/trackpad/click /input/trackpad/touch /input/grip/pose /input/aim/pose"},
    {"oculus/touch_controller", "Touch Controller", "", "/user/hand/left /user/hand/right",
     FOVERAY_TOUCH
     " /input/thumbrest/touch +/input/trigger/proximity +/input/thumb_resting_surfaces/proximity"},
    {"valve/index_controller", "Index Controller", "", "/user/hand/left /user/hand/right",
     "/input/system/click /input/system/touch /input/a/click /input/a/touch /input/b/click /input/b/touch "
     "/input/squeeze/value /input/squeeze/force /input/trigger/click /input/trigger/value "
     "/input/trigger/touch "
     "/input/thumbstick /input/thumbstick/x /input/thumbstick/y /input/thumbstick/click "
     "/input/thumbstick/touch "
     "/input/trackpad /input/trackpad/x /input/trackpad/y /input/trackpad/force /input/trackpad/touch "
     "/input/grip/pose /input/aim/pose /output/haptic"},
    {"ext/eye_gaze_interaction", "Eye Tracker", XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME, "/user/eyes_ext",
     "/input/gaze_ext/pose"},
    {"ml/ml2_controller", "Magic Leap 2 Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     "/input/menu/click /input/home/click /input/trigger/click /input/trigger/value /input/trackpad "
     "/input/trackpad/x /input/trackpad/y /input/trackpad/click /input/trackpad/force /input/trackpad/touch "
     "/input/grip/pose /input/aim/pose /input/shoulder/click /output/haptic"},
    {"bytedance/pico_neo3_controller", "PICO Neo3 Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     FOVERAY_PICO " /input/menu/click"},
    {"bytedance/pico4_controller", "PICO 4 Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     FOVERAY_PICO " </input/menu/click"},
    {"bytedance/pico_g3_controller", "PICO G3 Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     "/input/trigger/click /input/trigger/value /input/menu/click /input/grip/pose /input/aim/pose "
     "/input/thumbstick /input/thumbstick/click"},
    {"htc/vive_cosmos_controller", "Vive Cosmos Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     FOVERAY_VIVE " /input/shoulder/click"},
    {"htc/vive_focus3_controller", "Vive Focus 3 Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     FOVERAY_VIVE " /input/squeeze/touch /input/squeeze/value /input/trigger/touch /input/thumbrest/touch"},
    {"samsung/odyssey_controller", "Odyssey Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     "/input/menu/click /input/squeeze/click /input/trigger/value /input/thumbstick /input/thumbstick/x "
     "/input/thumbstick/y /input/thumbstick/click /input/trackpad /input/trackpad/x /input/trackpad/y "
     "/input/trackpad/click /input/trackpad/touch /input/grip/pose /input/aim/pose /output/haptic"},
    {"hp/mixed_reality_controller", "HP Mixed Reality Motion Controller", openxr_1_1,
     "/user/hand/left /user/hand/right",
     "</input/x/click </input/y/click >/input/a/click >/input/b/click /input/menu/click /input/squeeze/value "
     "/input/trigger/value /input/thumbstick /input/thumbstick/x /input/thumbstick/y /input/thumbstick/click "
     "/input/grip/pose /input/aim/pose /output/haptic"},
    {"meta/touch_pro_controller", "Touch Pro Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     FOVERAY_TOUCH FOVERAY_PROXIMITY
     " /input/thumbrest/touch /input/thumbrest/force /input/stylus/force "
     "/input/trigger_curl/value /input/trigger_slide/value /output/haptic_trigger /output/haptic_thumb"},
    {"meta/touch_plus_controller", "Touch Plus Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     FOVERAY_TOUCH FOVERAY_PROXIMITY " /input/thumbrest/touch /input/trigger_curl/value "
                                     "/input/trigger_slide/value /input/trigger/force"},
    {"meta/touch_controller_rift_cv1", "Rift CV1 Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     FOVERAY_TOUCH FOVERAY_PROXIMITY " /input/thumbrest/touch"},
    {"meta/touch_controller_quest_1_rift_s", "Quest and Rift S Controller", openxr_1_1,
     "/user/hand/left /user/hand/right", FOVERAY_TOUCH FOVERAY_PROXIMITY},
    {"meta/touch_controller_quest_2", "Quest 2 Controller", openxr_1_1, "/user/hand/left /user/hand/right",
     FOVERAY_TOUCH FOVERAY_PROXIMITY " /input/thumbrest/touch"},
};

std::vector<std::string_view> words(std::string_view text) {
    std::vector<std::string_view> list;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        if (end > 0) list.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return list;
}

std::string_view last_part(std::string_view path) { return path.substr(path.rfind('/') + 1); }

InputKind kind_of(std::string_view component) {
    const std::string_view part = last_part(component);
    if (component.starts_with("/output")) return InputKind::Haptic;
    if (part == "pose") return InputKind::Pose;
    if (part == "click" || part == "touch" || part == "proximity") return InputKind::Boolean;
    if (part == "value" || part == "force" || part == "x" || part == "y") return InputKind::Float;
    return InputKind::Vector2;
}

InteractionProfile make_profile(const ProfileText& text) {
    InteractionProfile profile{
        "/interaction_profiles/" + std::string(text.path), std::string(text.name), text.feature, {}};
    for (const std::string_view user : words(text.users)) {
        const auto add = [&](std::string_view component, std::string_view feature) {
            profile.sources.push_back({std::string(user) + std::string(component), std::string(user),
                                       std::string(component), kind_of(component), feature});
        };
        for (std::string_view component : words(text.components)) {
            const char mark = component.front();
            if ((mark == '<' && user != left_hand_path) || (mark == '>' && user != right_hand_path)) continue;
            if (mark != '/') component.remove_prefix(1);
            add(component, mark == '+' ? std::string_view(openxr_1_1) : text.feature);
            if (component == "/input/grip/pose") {
                add("/input/grip_surface/pose", text.feature.empty()
                                                    ? std::string_view(XR_KHR_MAINTENANCE1_EXTENSION_NAME)
                                                    : text.feature);
            }
        }
    }
    return profile;
}

/// .../input/trigger of .../input/trigger/value.
std::string_view identifier_path(const InputSource& source) {
    const std::size_t start = source.component.find('/', 1) + 1;
    const std::size_t length = std::min(source.component.find('/', start), source.component.size());
    return std::string_view(source.path).substr(0, source.user.size() + length);
}

/// OpenXR 1.0, section 11.4: Boolean and Float turn into each other; everything else must be alike.
bool goes_together(InputKind kind, XrActionType type) {
    switch (type) {
        case XR_ACTION_TYPE_BOOLEAN_INPUT:
        case XR_ACTION_TYPE_FLOAT_INPUT:
            return kind == InputKind::Boolean || kind == InputKind::Float;
        case XR_ACTION_TYPE_VECTOR2F_INPUT:
            return kind == InputKind::Vector2;
        case XR_ACTION_TYPE_POSE_INPUT:
            return kind == InputKind::Pose;
        case XR_ACTION_TYPE_VIBRATION_OUTPUT:
            return kind == InputKind::Haptic;
        default:
            return false;
    }
}

}  // namespace

const InputSource* InteractionProfile::find(std::string_view path_text, XrActionType type) const {
    for (const InputSource& source : sources) {
        if (source.path == path_text && goes_together(source.kind, type)) return &source;
    }
    const std::vector<std::string_view> preferred =
        type == XR_ACTION_TYPE_BOOLEAN_INPUT ? std::vector<std::string_view>{"/click", "/value", "/force"}
        : type == XR_ACTION_TYPE_FLOAT_INPUT ? std::vector<std::string_view>{"/value", "/force", "/click"}
                                             : std::vector<std::string_view>{"/pose"};
    for (const std::string_view component : preferred) {
        for (const InputSource& source : sources) {
            if (source.path == std::string(path_text) + std::string(component) &&
                goes_together(source.kind, type)) {
                return &source;
            }
        }
    }
    return nullptr;
}

bool InputSource::answers_to(std::string_view path_text) const {
    return path == path_text || identifier_path(*this) == path_text;
}

bool InteractionProfile::has_user(std::string_view user_path) const {
    return std::ranges::any_of(sources, [&](const InputSource& source) { return source.user == user_path; });
}

std::span<const InteractionProfile> interaction_profiles() {
    static const auto profiles = [] {
        std::vector<InteractionProfile> made;
        for (const ProfileText& text : profile_texts) made.push_back(make_profile(text));
        return made;
    }();
    return profiles;
}

const InteractionProfile* find_interaction_profile(std::string_view path) {
    const auto profiles = interaction_profiles();
    const auto found = std::ranges::find(profiles, path, &InteractionProfile::path);
    return found != profiles.end() ? &*found : nullptr;
}

bool is_user_path(std::string_view path, bool has_eyes) {
    return std::ranges::find(user_paths, path) != std::end(user_paths) && (has_eyes || path != eyes_path);
}

const InputSource* find_source(std::string_view path, InputKind kind) {
    for (const InteractionProfile& profile : interaction_profiles()) {
        for (const InputSource& source : profile.sources) {
            if (source.path == path && source.kind == kind) return &source;
        }
    }
    return nullptr;
}

std::optional<int> hand_of(std::string_view user_path) {
    if (user_path == left_hand_path) return 0;
    if (user_path == right_hand_path) return 1;
    return std::nullopt;
}

vec2 input_value(const InputSource& source, const ControllerState& state) {
    const std::string_view component = source.component;
    const auto is = [&](std::string_view identifier) {
        return component == identifier ||
               (component.starts_with(identifier) && component[identifier.size()] == '/');
    };
    const bool digital = source.kind == InputKind::Boolean;
    const auto analog = [&](float value) {
        return vec2(digital ? (value > 0.5f ? 1.0f : 0.0f) : value, 0.0f);
    };
    if (is("/input/trigger") || is("/input/select")) return analog(state.trigger);
    if (is("/input/squeeze")) return analog(state.squeeze);
    if (is("/input/a") || is("/input/x")) return vec2(state.primary_button, 0.0f);
    if (is("/input/b") || is("/input/y") || is("/input/menu")) return vec2(state.secondary_button, 0.0f);
    if (is("/input/thumbstick") || is("/input/trackpad")) {
        if (source.kind == InputKind::Vector2) return state.thumbstick;
        if (component.ends_with("/x")) return {state.thumbstick.x, 0.0f};
        if (component.ends_with("/y")) return {state.thumbstick.y, 0.0f};
        if (component.ends_with("/touch")) return vec2(glm::length(state.thumbstick) > 0.0f, 0.0f);
    }
    return vec2(0.0f);
}

std::string localized_name(const InteractionProfile& profile, const InputSource& source,
                           XrInputSourceLocalizedNameFlags which) {
    std::string name;
    const auto add = [&](std::string_view text) { name += (name.empty() ? "" : " ") + std::string(text); };
    if (which & XR_INPUT_SOURCE_LOCALIZED_NAME_USER_PATH_BIT) {
        const auto hand = hand_of(source.user);
        add(hand                             ? (*hand == 0 ? "Left Hand" : "Right Hand")
            : source.user == eyes_path       ? "Eyes"
            : source.user == "/user/gamepad" ? "Gamepad"
                                             : "Head");
    }
    if (which & XR_INPUT_SOURCE_LOCALIZED_NAME_INTERACTION_PROFILE_BIT) add(profile.name);
    if (which & XR_INPUT_SOURCE_LOCALIZED_NAME_COMPONENT_BIT) {
        std::string part = source.component.substr(source.component.find('/', 1) + 1);
        std::ranges::replace(part, '/', ' ');
        part.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(part.front())));
        add(part);
    }
    return name;
}

}  // namespace foveray::simulator
