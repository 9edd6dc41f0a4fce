#include <array>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "app/bench/tables.h"
#include "render/scene/load_scene.h"

namespace foveray::app {
namespace {

constexpr std::array polar_sizes{uvec2(788, 768), uvec2(1024, 1024)};  // an eye: HERR table 1
constexpr std::array light_samples{1, 64, 256};

const HeadsetProfile& headset() {
    static const HeadsetProfile profile = read_headset_profile("varjo-xr1");
    return profile;
}

/// Everything on, as the paper has it.
Settings herr_settings(int samples) {
    Settings settings;
    settings.shadow_samples = samples;
    settings.ambient_occlusion_samples = 1;
    settings.second_ray_depth = 1;
    settings.probe_rays = 128;
    settings.probe_sleeping = false;
    return settings;
}

/// The headset's four views, looking straight ahead.
Shot herr_shot(const scene::Scene& scene, int samples) {
    Shot shot;
    const Pose head = camera_pose(scene).value_or(Pose{});
    shot.views = headset_views(scene, headset());
    shot.acuity = headset().acuity;
    shot.gaze_origin = head.position;
    shot.gaze_direction = transform_direction(head, vec3(0.0f, 0.0f, -1.0f));
    shot.settings = herr_settings(samples);
    return shot;
}

/// The part of a context view that the same eye's focus view covers. Both look the same way.
HiddenMesh under(const Fov& focus) {
    const float left = std::tan(focus.left), right = std::tan(focus.right), up = std::tan(focus.up),
                down = std::tan(focus.down);
    return {{{left, down}, {right, down}, {right, up}, {left, up}}, {0, 1, 2, 0, 2, 3}, 1};
}

/// Every pixel that the wearer sees.
Shot full_resolution(const scene::Scene& scene, int samples) {
    Shot shot = herr_shot(scene, samples);
    shot.every_pixel = true;
    for (const View& view : shot.views) {
        HiddenMesh hidden;
        for (const View& other : shot.views) {
            if (view.role == ViewRole::Context && other.role == ViewRole::Focus && other.eye == view.eye)
                hidden = under(other.fov);
        }
        shot.hidden.push_back(std::move(hidden));
    }
    return shot;
}

}  // namespace

std::vector<BenchRow> herr_rows() {
    const auto load = [] { return scene::load_scene(assets_folder() / "scenes" / "herr.json"); };
    std::vector<BenchRow> rows;
    for (const uvec2 size : polar_sizes) {
        for (const int samples : light_samples) {
            rows.push_back({fmt::format("polar {} x {}, {} light samples", 2 * size.x, size.y, samples), load,
                            [=](const scene::Scene& scene) {
                                Shot shot = herr_shot(scene, samples);
                                shot.every_pixel = false;
                                set_polar_size(shot, size);
                                return shot;
                            }});
        }
    }
    for (const int samples : light_samples) {
        rows.push_back({fmt::format("full resolution, {} light samples", samples), load,
                        [=](const scene::Scene& scene) { return full_resolution(scene, samples); }});
    }
    return rows;
}

}  // namespace foveray::app
