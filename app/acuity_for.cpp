#include <algorithm>
#include <cmath>

#include "app/frame_loop.h"

namespace foveray::app {

Acuity acuity_for(const std::vector<View>& views) {
    Acuity acuity;
    acuity.cap_ppd = 0.0f;
    float outer = 0.0f;
    for (const View& view : views) {
        acuity.cap_ppd = std::max(acuity.cap_ppd, centre_ppd(view.fov, view.size.x));
        for (const vec2 corner : {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(1, 1)}) {
            const vec3 d = glm::normalize(direction_at(view.fov, corner));
            outer = std::max(outer, degrees(std::acos(-d.z)));
        }
    }
    constexpr float gaze_range = 30.0f;  // degrees that eyes turn off the head's forward
    acuity.outer_degrees = std::min(outer + gaze_range, 175.0f);
    return acuity;
}

}  // namespace foveray::app
