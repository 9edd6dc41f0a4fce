#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "base/json.h"

namespace foveray {

/// Everything that --set KEY=VALUE may change while the program runs. Plain values; `settings_table`
/// documents them and gives each its key, range and default.
struct Settings {
    // How dense samples are. 0 takes the headset profile's figure.
    float acuity_a = 0.0f;
    float acuity_b = 0.0f;
    float cap_ppd = 0.0f;
    float resolution_scale = 1.0f;
    float angular_ratio = 0.9746f;  // HERR table 1: 768 angular for 788 radial samples
    bool gaze_tracking = true;
    float blink_hold_ms = 200.0f;
    float fixed_fovea_degrees = 10.0f;
    std::string resolve_filter = "bicubic";
    int reference_samples = 1;
    bool history_temporal = true;
    bool history_spatial = true;
    float mesh_error = 0.5f;

    // How much of it a frame may take (base/quality.h, render/ray_budget.h).
    std::string quality_level = "automatic";
    float gpu_share = 0.8f;
    float least_scale = 0.5f;

    // What light does.
    int shadow_samples = 4;
    bool shadows = true;
    bool adaptive_shadows = true;
    bool reflections = true;
    float reflection_max_roughness = 0.5f;
    int second_ray_depth = 1;
    int ambient_occlusion_samples = 1;
    float ambient_occlusion_m = 0.25f;
    float environment_intensity = 1.0f;
    int max_transparent_layers = 4;
    bool probes = true;
    int probe_rays = 64;
    bool probe_sleeping = true;

    // How the picture is made.
    float exposure_ev = 0.0f;
    std::string tone_mapping = "neutral";
    float camera_exposure_ev = 0.0f;
    bool camera_blend = true;
    float near_m = 0.05f;
    float far_m = 100.0f;
    std::string debug_view = "none";
};

struct SettingInfo {
    using Member =
        std::variant<float Settings::*, int Settings::*, bool Settings::*, std::string Settings::*>;
    std::string_view key;
    Member member;
    double minimum, maximum;                    // numbers
    std::span<const std::string_view> choices;  // strings
    std::string_view help;
    std::string_view zero = {};  // what 0 stands for, where it is no number of its own
};

std::span<const SettingInfo> settings_table();
/// `assignment` is "key=value". Throws Fault(BadInput) naming the nearest key, the range or the choices.
void set(Settings& settings, std::string_view assignment);
/// The value with its own type; floats as short as they read back.
Json value_json(const Settings& settings, const SettingInfo& info);
/// The value as it would be written after "key=".
std::string value_text(const Settings& settings, const SettingInfo& info);

}  // namespace foveray
