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

using ScenePtr = std::shared_ptr<const scene::Scene>;

ScenePtr load(const fs::path& file) { return std::make_shared<const scene::Scene>(scene::load_scene(file)); }

/// One shadow ray a light and hit, one reflection.
Settings light_settings() {
    Settings settings;
    settings.shadow_samples = 1;
    return settings;
}

BenchRow every_pixel(const std::string& name, ScenePtr scene) {
    BenchRow row{name + ", 1920 x 1080", scene, {}};
    row.shot.views = {camera_view(*scene, full_hd)};
    row.shot.settings = light_settings();
    return row;
}

/// Looks along the camera's axis.
BenchRow polar(const std::string& name, ScenePtr scene) {
    static const HeadsetProfile headset = read_headset_profile("vive-pro-eye");
    BenchRow row{name + ", polar 1576 x 768", scene, {}};
    const Pose head = camera_pose(*scene).value_or(Pose{});
    row.shot.views = headset_views(*scene, headset);
    row.shot.every_pixel = false;
    row.shot.acuity = headset.acuity;
    row.shot.gaze_origin = head.position;
    row.shot.gaze_direction = transform_direction(head, vec3(0.0f, 0.0f, -1.0f));
    row.shot.settings = light_settings();
    set_polar_size(row.shot, polar_size);
    return row;
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
    for (const fs::path& file : scene_files(scenes / "shapes")) {
        const ScenePtr scene = load(file);
        rows.push_back(every_pixel(file.stem().string(), scene));
        rows.push_back(polar(file.stem().string(), scene));
    }
    for (const auto& [name, file] : {std::pair{"paper's scene", "proceduray.json"},
                                     std::pair{"every shape", "shapes.json"},
                                     std::pair{"voxels, triangles and a user's shape", "mixed.json"}}) {
        const ScenePtr scene = load(scenes / file);
        rows.push_back(every_pixel(name, scene));
        rows.push_back(polar(name, scene));
    }
    return rows;
}

}  // namespace foveray::app
