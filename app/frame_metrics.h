#pragma once

#include <array>

#include "app/report/run_report.h"
#include "base/frame.h"
#include "shaders/shared/sample_grid.h"

namespace foveray::app {

/// Times and gaze of a frame: its angles in the head's frame, and where each eye's gaze meets its context
/// view. `gaze_frames`: left and right eye's, world space.
FrameMetrics frame_metrics(const Frame& frame, const Pose& world_from_stage,
                           const std::array<shared::GazeFrame, 2>& gaze_frames);

}  // namespace foveray::app
