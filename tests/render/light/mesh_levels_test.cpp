#include <iostream>

#include "base/headset_profile.h"
#include "render/scene/load_scene.h"
#include "tests/fakes/gpu_fixture.h"
#include "tests/render/light/light_rig.h"

namespace foveray::render {
namespace {

using MeshLevelsTest = fakes::GpuTest;

struct Difference {
    double mean = 0.0;     // of what the display shows, 0..1
    double visible = 0.0;  // part of the pixels that differ by more than 8 of 255
};

Difference compare(const Picture& a, const Picture& b) {
    Difference d;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        double most = 0.0;
        for (int c = 0; c < 3; ++c) {
            const auto shown = [&](const Picture& p) {
                return double{srgb_from_linear(glm::clamp(p.pixels[i].radiance[c], 0.0f, 1.0f))};
            };
            const double difference = std::abs(shown(a) - shown(b));
            d.mean += difference / 3.0;
            most = std::max(most, difference);
        }
        d.visible += most > 8.0 / 255.0;
    }
    d.mean /= static_cast<double>(a.pixels.size());
    d.visible /= static_cast<double>(a.pixels.size());
    return d;
}

TEST_F(MeshLevelsTest, FewerTrianglesMakeTheSamePicture) {
    const scene::Scene scene = scene::load_scene(assets_folder() / "scenes/herr.json");
    const HeadsetProfile headset = read_headset_profile("ci");
    LightRig rig(device(), scene);
    Shot shot;
    shot.acuity = headset.acuity;
    shot.every_pixel = false;
    shot.read_samples = false;
    const vec3 eye = scene.nodes.back().local.translation;
    shot.fovea = {eye, glm::normalize(vec3(-0.3f, -0.1f, -1.0f)), 0.0f, true};
    shot.views = {square_view(45.0f, 256, {quat(1, 0, 0, 0), eye})};
    shot.settings.shadow_samples = 1;
    // What differs from frame to frame, whatever the triangles.
    shot.settings.probes = false;
    shot.settings.history_temporal = false;
    shot.settings.ambient_occlusion_samples = 0;

    shot.settings.mesh_error = 0.0f;
    const Rendered full = rig.render(shot);
    shot.settings.mesh_error = 0.5f;
    const Rendered fewer = rig.render(shot);
    shot.settings.mesh_error = 16.0f;
    const Rendered coarse = rig.render(shot);

    const Difference difference = compare(full.views[0], fewer.views[0]);
    const Difference too_coarse = compare(full.views[0], coarse.views[0]);
    std::cout << full.triangles << " triangles, " << fewer.triangles << " and " << coarse.triangles
              << " with levels; mean difference " << 255.0 * difference.mean << " and "
              << 255.0 * too_coarse.mean << " of 255, visible " << 100.0 * difference.visible << " and "
              << 100.0 * too_coarse.visible << " %\n";
    // Some two fifths of the triangles are the hall's, round the eye, and stay.
    EXPECT_LT(fewer.triangles, full.triangles * 9 / 10);
    EXPECT_LT(coarse.triangles, fewer.triangles);
    EXPECT_LT(255.0 * difference.mean, 0.1);
    EXPECT_LT(difference.visible, 0.004);
    EXPECT_GT(too_coarse.mean, 2.0 * difference.mean) << "the comparison does not see errors";
}

}  // namespace
}  // namespace foveray::render
