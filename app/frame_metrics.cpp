#include "app/frame_metrics.h"

#include <algorithm>
#include <cmath>

namespace foveray::app {

FrameMetrics frame_metrics(const Frame& frame, const Pose& world_from_stage,
                           const std::array<shared::GazeFrame, 2>& gaze_frames) {
    FrameMetrics metrics;
    metrics.index = frame.index;
    metrics.display_time = frame.time;
    metrics.gaze_valid = frame.gaze.valid;
    if (frame.gaze.valid) {
        const vec3 d = transform_direction(inverse(frame.stage_from_head), frame.gaze.direction);
        metrics.gaze_yaw_degrees = degrees(std::atan2(d.x, -d.z));
        metrics.gaze_pitch_degrees = degrees(std::asin(std::clamp(d.y, -1.0f, 1.0f)));
    }
    for (std::size_t eye = 0; eye < 2 && eye < frame.views.size(); ++eye) {
        const View& view = frame.views[eye];
        const Pose eye_from_world = inverse(world_from_stage * view.stage_from_eye);
        const vec3 forward = transform_direction(eye_from_world, gaze_frames[eye].forward);
        if (forward.z >= 0.0f) continue;
        const vec2 mark = uv_of(view.fov, forward);
        const bool inside = mark.x >= 0.0f && mark.x <= 1.0f && mark.y >= 0.0f && mark.y <= 1.0f;
        if (inside) metrics.gaze_mark[eye] = mark;
    }
    return metrics;
}

}  // namespace foveray::app
