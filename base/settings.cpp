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
constexpr std::array tone_mappers = {sv("neutral"), sv("none")};
constexpr std::array debug_views = {sv("none"),   sv("tiles"),  sv("samples"), sv("normal"),
                                    sv("albedo"), sv("shadow"), sv("depth")};

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
    {"reference.samples", &S::reference_samples, 1, 1024, {}, "samples a pixel with --reference"},
    {"lod.mesh_error",
     &S::mesh_error,
     0,
     16,
     {},
     "greatest error of meshes with fewer triangles, samples; 0: all triangles",
     "all triangles"},
    {"lighting.shadows", &S::shadows, 0, 1, {}, "trace shadow rays"},
    {"lighting.shadow_samples", &S::shadow_samples, 1, 256, {}, "shadow rays per hit towards an area light"},
    {"lighting.reflections", &S::reflections, 0, 1, {}, "trace one mirror reflection"},
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
