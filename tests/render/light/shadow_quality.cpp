#include "tests/render/light/shadow_quality.h"

#include <cmath>

#include <gtest/gtest.h>

namespace foveray::render {

Seen seen(LightRig& rig, Shot shot, int samples, bool adaptive) {
    shot.settings.shadow_samples = samples;
    shot.settings.adaptive_shadows = adaptive;
    shot.settings.debug_view = "shadow";
    const Rendered rendered = rig.render(shot);
    Seen result;
    for (const auto& light : rendered.light) result.part.push_back(light.radiance);
    result.rays = rendered.rays[shared::COUNT_SHADOW];
    return result;
}

double penumbra_error(const Seen& found, const Seen& truth, int color) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < truth.part.size(); ++i) {
        if (truth.part[i][color] <= 0.0f || truth.part[i][color] >= 1.0f) continue;
        const double error = found.part[i][color] - truth.part[i][color];
        sum += error * error;
        ++count;
    }
    EXPECT_GT(count, 100);
    return std::sqrt(sum / std::max(count, 1));
}

void expect_adaptive_as_good(LightRig& rig, const Shot& shot, int colors, int true_samples,
                             const std::vector<int>& counts) {
    const Seen truth = seen(rig, shot, true_samples, false);
    for (const int samples : counts) {
        const Seen all = seen(rig, shot, samples, false), adaptive = seen(rig, shot, samples, true);
        const double rays = static_cast<double>(adaptive.rays) / static_cast<double>(all.rays);
        EXPECT_LT(rays, 0.75) << samples;
        for (int color = 0; color < colors; ++color) {
            const double error = penumbra_error(all, truth, color);
            const double ratio = penumbra_error(adaptive, truth, color) / error;
            EXPECT_LE(ratio, 1.1) << samples << ' ' << color;
            std::printf("%d samples: error %.4f, adaptive %.3f times that with %.2f of the rays\n", samples,
                        error, ratio, rays);
        }
    }
}

}  // namespace foveray::render
