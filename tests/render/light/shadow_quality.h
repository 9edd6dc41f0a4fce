#pragma once

#include "tests/render/light/light_rig.h"

namespace foveray::render {

/// By sample, the part of the lights' irradiance that arrives, RGB: lights of one primary colour each are
/// told apart.
struct Seen {
    std::vector<vec3> part;
    std::uint64_t rays = 0;
};

Seen seen(LightRig& rig, Shot shot, int samples, bool adaptive);
/// Root of the mean square over what lies in a penumbra, of one primary colour's light.
double penumbra_error(const Seen& found, const Seen& truth, int color = 0);
/// At most 1.1 times all samples' error against `true_samples`, by each of the first primary colours.
void expect_adaptive_as_good(LightRig& rig, const Shot& shot, int colors = 1, int true_samples = 4096,
                             const std::vector<int>& counts = {64, 256});

}  // namespace foveray::render
