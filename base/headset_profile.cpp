#include "base/headset_profile.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <dlfcn.h>

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
    const float tangents = std::tan(view.fov.right) - std::tan(view.fov.left);
    view.ppd = json.value("ppd", static_cast<float>(view.size.x) / tangents * radians(1.0f));
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

std::vector<HeadsetProfile::ViewProfile> read_views(const Json& json, const std::string& where) {
    const auto context = read_view(json.at("context"), ViewRole::Context, where + "/context");
    std::vector<HeadsetProfile::ViewProfile> views{context, mirrored(context)};
    if (json.contains("focus")) {
        const auto focus = read_view(json.at("focus"), ViewRole::Focus, where + "/focus");
        if (!contains(context.fov, focus.fov)) {
            throw_bad_input(where + "/focus/fov_degrees", "reaches outside the context's", "make it smaller");
        }
        views.push_back(focus);
        views.push_back(mirrored(focus));
    }
    return views;
}

BlendMode read_blend_mode(const std::string& name) {
    if (name == "opaque") return BlendMode::Opaque;
    return name == "additive" ? BlendMode::Additive : BlendMode::AlphaBlend;
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

fs::path assets_folder() {
    if (const char* variable = std::getenv("FOVERAY_ASSETS"); variable && *variable) {
        if (fs::is_directory(variable)) return variable;
        throw_bad_input(std::string("FOVERAY_ASSETS=") + variable, "is not a folder", "unset or correct it");
    }
    std::error_code ignored;
    for (const fs::path& folder : {fs::read_symlink("/proc/self/exe", ignored).parent_path(), own_folder()}) {
        for (const fs::path& assets : {folder / "../share/foveray/assets", folder / "assets"}) {
            if (!folder.empty() && fs::is_directory(assets, ignored)) return assets.lexically_normal();
        }
    }
    const fs::path source = fs::path(FOVERAY_SOURCE_DIR) / "assets";
    if (fs::is_directory(source, ignored)) return source;
    throw_missing("assets", "the folder with headset profiles was not found",
                  "set FOVERAY_ASSETS to foveray's assets folder");
}

}  // namespace foveray
