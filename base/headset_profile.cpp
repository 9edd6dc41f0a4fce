#include "base/headset_profile.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <dlfcn.h>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/json.h"
#include "embedded/headset_schema.h"

namespace foveray {
namespace {

namespace fs = std::filesystem;

Fov read_fov(const Json& json, const std::string& where) {
    const Fov fov{radians(json.at("left")), radians(json.at("right")), radians(json.at("up")),
                  radians(json.at("down"))};
    if (!(fov.left < fov.right && fov.down < fov.up)) {
        throw_bad_input(where + "/fov_degrees", "is empty", "left must be below right, and down below up");
    }
    return fov;
}

HeadsetProfile::ViewProfile read_view(const Json& json, ViewRole role, const std::string& where) {
    HeadsetProfile::ViewProfile view;
    view.role = role;
    view.size = {json.at("width"), json.at("height")};
    view.fov = read_fov(json.at("fov_degrees"), where);
    view.ppd = json.value("ppd", centre_ppd(view.fov, view.size.x));
    return view;
}

HeadsetProfile::ViewProfile mirrored(HeadsetProfile::ViewProfile view) {
    view.eye = Eye::Right;
    view.fov = {-view.fov.right, -view.fov.left, view.fov.up, view.fov.down};
    return view;
}

bool contains(const Fov& outer, const Fov& inner) {
    return outer.left <= inner.left && inner.right <= outer.right && outer.down <= inner.down &&
           inner.up <= outer.up;
}

/// The context view and, where there is one, the focus view of an eye.
std::vector<HeadsetProfile::ViewProfile> read_eye(const Json& json, const std::string& where) {
    std::vector views{read_view(json.at("context"), ViewRole::Context, where + "/context")};
    if (json.contains("focus")) {
        views.push_back(read_view(json.at("focus"), ViewRole::Focus, where + "/focus"));
        if (!contains(views[0].fov, views[1].fov)) {
            throw_bad_input(where + "/focus/fov_degrees", "reaches outside the context's", "make it smaller");
        }
    }
    return views;
}

std::vector<HeadsetProfile::ViewProfile> read_views(const Json& json, const std::string& where) {
    const auto left = read_eye(json, where);
    auto right = left;
    if (json.contains("right")) {
        right = read_eye(json.at("right"), where + "/right");
        if (right.size() != left.size()) {
            throw_bad_input(where + "/right", "has other views than the left eye",
                            "give a focus view to both eyes or to none");
        }
        for (auto& view : right) view.eye = Eye::Right;
    } else {
        for (auto& view : right) view = mirrored(view);
    }
    std::vector<HeadsetProfile::ViewProfile> views;
    for (std::size_t i = 0; i < left.size(); ++i) views.insert(views.end(), {left[i], right[i]});
    return views;
}

double in_degrees(float radians) { return double{radians} * 180.0 / std::numbers::pi; }

Json view_json(const HeadsetProfile::ViewProfile& view) {
    return {{"width", view.size.x},
            {"height", view.size.y},
            {"fov_degrees",
             {{"left", in_degrees(view.fov.left)},
              {"right", in_degrees(view.fov.right)},
              {"up", in_degrees(view.fov.up)},
              {"down", in_degrees(view.fov.down)}}},
            {"ppd", shortest(view.ppd)}};
}

/// `eye`: 0 left, 1 right.
Json eye_json(const HeadsetProfile& profile, std::size_t eye) {
    Json json = {{"context", view_json(profile.views[eye])}};
    if (profile.views.size() > 2) json["focus"] = view_json(profile.views[eye + 2]);
    return json;
}

constexpr std::pair<BlendMode, std::string_view> blend_mode_names[] = {
    {BlendMode::Opaque, "opaque"}, {BlendMode::Additive, "additive"}, {BlendMode::AlphaBlend, "alpha_blend"}};

BlendMode read_blend_mode(const std::string& name) {
    return std::ranges::find(blend_mode_names, name, [](const auto& entry) { return entry.second; })->first;
}

std::vector<vec2> read_outline(const Json& json, const Fov& fov, const std::string& where) {
    std::vector<vec2> outline;
    for (const Json& point : json) outline.emplace_back(point[0].get<float>(), point[1].get<float>());
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const vec2 a = outline[i], b = outline[(i + 1) % outline.size()],
                   c = outline[(i + 2) % outline.size()];
        const vec2 ab = b - a, bc = c - b;
        if (ab.x * bc.y - ab.y * bc.x <= 0.0f) {
            throw_bad_input(where + "/" + std::to_string((i + 1) % outline.size()),
                            "is no corner of a convex counter-clockwise outline", "reorder or remove it");
        }
        if (a.x < std::tan(fov.left) || a.x > std::tan(fov.right) || a.y < std::tan(fov.down) ||
            a.y > std::tan(fov.up)) {
            throw_bad_input(where + "/" + std::to_string(i), "is outside the context's field of view",
                            "give tangents of angles inside it");
        }
    }
    return outline;
}

HeadsetProfile read_profile_file(const fs::path& file) {
    const Json json = read_json(file);
    check_json(json, headset_schema, file);
    const std::string root = file.string() + ": ";

    HeadsetProfile profile;
    profile.name = file.stem().string();
    profile.display_name = json.at("display_name");
    profile.source = json.at("source");
    profile.rate_hz = json.at("rate_hz");
    profile.ipd = json.value("ipd_m", profile.ipd);
    profile.eye_tracking = json.value("eye_tracking", false);
    profile.views = read_views(json.at("views"), root + "/views");
    for (const Json& mode : json.at("blend_modes")) profile.blend_modes.push_back(read_blend_mode(mode));
    profile.interaction_profile = json.at("interaction_profile");
    const Json& acuity = json.at("acuity");
    profile.acuity = {acuity.at("a"), acuity.at("b"), acuity.at("cap_ppd"), acuity.at("outer_degrees")};
    profile.foveated_focus_scale = json.value("foveated_focus_scale", 1.0f);
    if (json.contains("hidden_outline")) {
        profile.hidden_outline =
            read_outline(json.at("hidden_outline"), profile.views.front().fov, root + "/hidden_outline");
    }
    return profile;
}

std::string profile_names(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const fs::path& file = entry.path();
        if (file.extension() == ".json" && file.stem().extension() != ".schema") names.push_back(file.stem());
    }
    std::sort(names.begin(), names.end());
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none" : list;
}

/// Folder of the program or library that this code is linked into.
fs::path own_folder() {
    Dl_info info{};
    if (!dladdr(reinterpret_cast<const void*>(&own_folder), &info) || !info.dli_fname) return {};
    std::error_code ignored;
    return fs::absolute(info.dli_fname, ignored).parent_path();
}

}  // namespace

HeadsetProfile read_headset_profile(const std::string& name_or_file) {
    if (fs::path(name_or_file).extension() == ".json") return read_profile_file(name_or_file);
    const fs::path folder = assets_folder() / "headsets";
    const fs::path file = folder / (name_or_file + ".json");
    if (name_or_file.empty() || name_or_file.find('/') != std::string::npos || !fs::is_regular_file(file)) {
        throw_bad_input("headset '" + name_or_file + "'", "is not known",
                        "use one of " + profile_names(folder) + ", or the path of a .json file");
    }
    return read_profile_file(file);
}

void write_headset_profile(const fs::path& file, const HeadsetProfile& profile) {
    Json json = {{"format", "foveray-headset"},
                 {"version", 1},
                 {"display_name", profile.display_name},
                 {"source", profile.source},
                 {"rate_hz", profile.rate_hz},
                 {"ipd_m", shortest(profile.ipd)},
                 {"eye_tracking", profile.eye_tracking},
                 {"views", eye_json(profile, 0)},
                 {"foveated_focus_scale", shortest(profile.foveated_focus_scale)},
                 {"blend_modes", Json::array()},
                 {"interaction_profile", profile.interaction_profile},
                 {"acuity",
                  {{"a", shortest(profile.acuity.a)},
                   {"b", shortest(profile.acuity.b)},
                   {"cap_ppd", shortest(profile.acuity.cap_ppd)},
                   {"outer_degrees", shortest(profile.acuity.outer_degrees)}}}};
    json["views"]["right"] = eye_json(profile, 1);
    for (const BlendMode mode : profile.blend_modes) {
        json["blend_modes"].push_back(
            std::ranges::find(blend_mode_names, mode, [](const auto& entry) { return entry.first; })->second);
    }
    for (const vec2 point : profile.hidden_outline)
        json["hidden_outline"].push_back({shortest(point.x), shortest(point.y)});
    write_json(file, json);
}

fs::path assets_folder() {
    if (const char* variable = std::getenv("FOVERAY_ASSETS"); variable && *variable) {
        if (fs::is_directory(variable)) return variable;
        throw_bad_input(std::string("FOVERAY_ASSETS=") + variable, "is not a folder", "unset or correct it");
    }
    std::error_code ignored;
    const fs::path folder = own_folder();  // not the program's, which may be anybody's
    for (const fs::path& assets : {folder / "../share/foveray/assets", folder / "assets"}) {
        if (!folder.empty() && fs::is_directory(assets, ignored)) return assets.lexically_normal();
    }
    const fs::path source = fs::path(FOVERAY_SOURCE_DIR) / "assets";
    if (fs::is_directory(source, ignored)) return source;
    throw_missing("assets", "the folder with headset profiles was not found",
                  "set FOVERAY_ASSETS to foveray's assets folder");
}

}  // namespace foveray
