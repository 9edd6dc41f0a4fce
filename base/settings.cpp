#include "base/settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace foveray {
namespace {

using S = Settings;
using sv = std::string_view;

constexpr std::array filters = {sv("bilinear"), sv("bicubic")};
constexpr std::array quality_levels = {sv("automatic"), sv("manual"), sv("low"),
                                       sv("medium"),    sv("high"),   sv("best")};
constexpr std::array tone_mappers = {sv("neutral"), sv("none")};
constexpr std::array debug_views = {sv("none"),   sv("tiles"),  sv("samples"), sv("normal"),
                                    sv("albedo"), sv("shadow"), sv("depth"), sv("probes")};

constexpr std::array table = std::to_array<SettingInfo>({
    {"foveation.acuity_a",
     &S::acuity_a,
     0,
     2000,
     {},
     "a of ppd(e) = a / (e + b), e in degrees; 0: the headset's",
     "the headset's"},
    {"foveation.acuity_b",
     &S::acuity_b,
     0,
     60,
     {},
     "b of ppd(e), degrees; 0: the headset's",
     "the headset's"},
    {"foveation.cap_ppd",
     &S::cap_ppd,
     0,
     500,
     {},
     "most pixels per degree worth tracing; 0: the headset's",
     "the headset's"},
    {"foveation.resolution_scale", &S::resolution_scale, 0.1, 4, {}, "scales both axes of the polar image"},
    {"foveation.angular_ratio", &S::angular_ratio, 0.1, 4, {}, "angular samples per radial sample"},
    {"foveation.gaze_tracking", &S::gaze_tracking, 0, 1, {}, "follow the eyes; off: a fixed, wider fovea"},
    {"foveation.blink_hold_ms", &S::blink_hold_ms, 0, 2000, {}, "how long the last gaze is held in a blink"},
    {"foveation.fixed_fovea_degrees", &S::fixed_fovea_degrees, 0, 60, {}, "radius of the fovea without gaze"},
    {"resolve.filter", &S::resolve_filter, 0, 0, filters, "how polar samples become pixels"},
    {"history.temporal", &S::history_temporal, 0, 1, {}, "polar samples settle over a few frames"},
    {"history.spatial", &S::history_spatial, 0, 1, {}, "smooth the noise of shadows between polar samples"},
    {"reference.samples", &S::reference_samples, 1, 1024, {}, "samples a pixel with --reference"},
    {"lod.mesh_error",
     &S::mesh_error,
     0,
     16,
     {},
     "greatest error of meshes with fewer triangles, samples; 0: all triangles",
     "all triangles"},
    {"quality.level", &S::quality_level, 0, 0, quality_levels,
     "sample counts, where they are at their defaults; automatic: view follows GPU and head, replay the "
     "recording"},
    {"budget.gpu_share",
     &S::gpu_share,
     0,
     1,
     {},
     "part of the display's period that view fits a frame into; 0: no limit",
     "no limit"},
    {"budget.least_scale",
     &S::least_scale,
     0.25,
     1,
     {},
     "how far that may scale the polar image's axes down"},
    {"lighting.shadows", &S::shadows, 0, 1, {}, "trace shadow rays"},
    {"lighting.shadow_samples", &S::shadow_samples, 1, 256, {}, "shadow rays per hit towards an area light"},
    {"lighting.adaptive_shadows",
     &S::adaptive_shadows,
     0,
     1,
     {},
     "from 16 shadow samples on, take all of them only in penumbras"},
    {"lighting.reflections", &S::reflections, 0, 1, {}, "trace mirror reflections"},
    {"lighting.second_ray_depth",
     &S::second_ray_depth,
     1,
     8,
     {},
     "surfaces that a reflected or refracted ray may meet"},
    {"lighting.ambient_occlusion_samples",
     &S::ambient_occlusion_samples,
     0,
     64,
     {},
     "short rays per hit that look for what keeps ambient light away"},
    {"lighting.ambient_occlusion_m",
     &S::ambient_occlusion_m,
     0.001,
     10,
     {},
     "how far those rays reach, metres"},
    {"lighting.reflection_max_roughness",
     &S::reflection_max_roughness,
     0,
     1,
     {},
     "rougher surfaces mirror only the environment"},
    {"lighting.environment_intensity",
     &S::environment_intensity,
     0,
     100,
     {},
     "scales the environment's light"},
    {"lighting.max_transparent_layers",
     &S::max_transparent_layers,
     1,
     16,
     {},
     "see-through surfaces along a ray"},
    {"probes.enabled", &S::probes, 0, 1, {}, "indirect light from the scene's probes, if it has any"},
    {"probes.rays", &S::probe_rays, 16, 256, {}, "rays that a probe sends each frame"},
    {"probes.sleeping", &S::probe_sleeping, 0, 1, {}, "probes with nothing near them look about less often"},
    {"picture.exposure_ev", &S::exposure_ev, -16, 16, {}, "exposure of the virtual part, stops"},
    {"picture.tone_mapping", &S::tone_mapping, 0, 0, tone_mappers, "Khronos PBR Neutral, or none"},
    {"picture.near_m", &S::near_m, 0.001, 10, {}, "near plane of the depth layer"},
    {"picture.far_m", &S::far_m, 1, 100000, {}, "far plane of the depth layer"},
    {"picture.debug_view", &S::debug_view, 0, 0, debug_views, "what the views show instead of light"},
    {"camera.exposure_ev", &S::camera_exposure_ev, -16, 16, {}, "exposure of the camera picture, stops"},
    {"camera.blend", &S::camera_blend, 0, 1, {}, "show the camera behind the virtual part"},
});

[[noreturn]] void throw_bad_value(const SettingInfo& info, sv value, const std::string& expected) {
    throw_bad_input("--set " + std::string(info.key), "'" + std::string(value) + "' is not " + expected,
                    "see `foveray settings`");
}

std::string range_text(const SettingInfo& info) {
    std::ostringstream out;
    out << "between " << info.minimum << " and " << info.maximum;
    return out.str();
}

template <typename Number>
Number parse_number(const SettingInfo& info, sv text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const double d = static_cast<double>(value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(d) || d < info.minimum ||
        d > info.maximum) {
        throw_bad_value(info, text,
                        (std::is_integral_v<Number> ? "a whole number " : "a number ") + range_text(info));
    }
    return value;
}

}  // namespace

std::span<const SettingInfo> settings_table() { return table; }

void set(Settings& settings, sv assignment) {
    const std::size_t equals = assignment.find('=');
    const sv key = assignment.substr(0, equals);
    if (equals == sv::npos) {
        throw_bad_input("--set " + std::string(assignment), "has no '='", "write --set KEY=VALUE");
    }
    const sv value = assignment.substr(equals + 1);
    const auto it =
        std::find_if(table.begin(), table.end(), [&](const auto& info) { return info.key == key; });
    if (it == table.end()) {
        std::vector<sv> keys;
        for (const SettingInfo& info : table) keys.push_back(info.key);
        throw_bad_input("--set " + std::string(key), "is no setting",
                        "did you mean " + std::string(nearest(key, keys)) + "? `foveray settings` lists all");
    }
    const SettingInfo& info = *it;
    if (const auto* f = std::get_if<float S::*>(&info.member)) {
        settings.*(*f) = parse_number<float>(info, value);
    } else if (const auto* i = std::get_if<int S::*>(&info.member)) {
        settings.*(*i) = parse_number<int>(info, value);
    } else if (const auto* b = std::get_if<bool S::*>(&info.member)) {
        const bool on = value == "1" || value == "true" || value == "on";
        const bool off = value == "0" || value == "false" || value == "off";
        if (!on && !off) throw_bad_value(info, value, "on or off");
        settings.*(*b) = on;
    } else {
        if (std::find(info.choices.begin(), info.choices.end(), value) == info.choices.end()) {
            std::string expected = "one of";
            for (sv choice : info.choices) expected += " " + std::string(choice);
            throw_bad_value(info, value, expected);
        }
        settings.*std::get<std::string S::*>(info.member) = value;
    }
}

Json value_json(const Settings& settings, const SettingInfo& info) {
    if (const auto* f = std::get_if<float S::*>(&info.member)) return shortest(settings.*(*f));
    return std::visit([&](auto member) { return Json(settings.*member); }, info.member);
}

std::string value_text(const Settings& settings, const SettingInfo& info) {
    std::ostringstream out;
    std::visit([&](auto member) { out << std::boolalpha << settings.*member; }, info.member);
    return out.str();
}

}  // namespace foveray
