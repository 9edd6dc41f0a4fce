#include <algorithm>

#include "app/bench/tables.h"
#include "base/error.h"
#include "render/scene/load_scene.h"
#include "shaders/shared/polar.h"

namespace foveray::app {
namespace {

namespace fs = std::filesystem;

constexpr uvec2 full_hd{1920, 1080};
constexpr uvec2 polar_size{788, 768};  // an eye: HERR table 1, 1576 x 768 for both

/// One shadow ray a light and hit, one reflection, and nothing more.
Settings light_settings() {
    Settings settings;
    settings.shadow_samples = 1;
    settings.ambient_occlusion_samples = 0;
    return settings;
}

Shot every_pixel(const scene::Scene& scene) {
    Shot shot;
    shot.views = {camera_view(scene, full_hd)};
    shot.settings = light_settings();
    return shot;
}

/// Looks along the camera's axis.
Shot polar(const scene::Scene& scene) {
    static const HeadsetProfile headset = read_headset_profile("vive-pro-eye");
    Shot shot;
    const Pose head = camera_pose(scene).value_or(Pose{});
    shot.views = headset_views(scene, headset);
    shot.every_pixel = false;
    shot.acuity = headset.acuity;
    shot.gaze_origin = head.position;
    shot.gaze_direction = transform_direction(head, vec3(0.0f, 0.0f, -1.0f));
    shot.settings = light_settings();
    set_polar_size(shot, polar_size);
    return shot;
}

std::vector<fs::path> scene_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
}

}  // namespace

std::vector<BenchRow> procedural_rows() {
    const fs::path scenes = assets_folder() / "scenes";
    std::vector<BenchRow> rows;
    const auto add = [&](const std::string& name, const fs::path& file) {
        const auto load = [file] { return scene::load_scene(file); };
        rows.push_back({name + ", 1920 x 1080", load, every_pixel});
        rows.push_back({name + ", polar 1576 x 768", load, polar});
    };
    for (const fs::path& file : scene_files(scenes / "shapes")) add(file.stem().string(), file);
    add("paper's scene", scenes / "proceduray.json");
    add("every shape", scenes / "shapes.json");
    add("voxels, triangles and a user's shape", scenes / "mixed.json");
    return rows;
}

}  // namespace foveray::app
