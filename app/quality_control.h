#pragma once

#include <deque>
#include <optional>

#include "app/report/run_report.h"
#include "base/frame.h"
#include "base/session.h"
#include "render/ray_budget.h"

namespace foveray::app {

/// Chooses what each frame of a live view is traced with, from what earlier ones took: `budget.*` and
/// `quality.level` say how.
class QualityControl {
  public:
    /// Once for each rendered frame, in order. `wanted`: what the user set. `newest`: of the newest frame
    /// that the GPU has finished.
    Settings choose(const Settings& wanted, const Frame& frame, const std::optional<FrameMetrics>& newest);

  private:
    float head_speed(const Frame& frame, double seconds);

    struct Traced {
        std::uint64_t index = 0;
        render::RayChoice choice;
    };
    render::RayBudget budget_;
    std::deque<Traced> traced_;  // frames whose metrics were not seen yet, oldest first
    std::optional<Nanoseconds> last_time_;
    std::optional<quat> last_head_;
};

/// What a frame at `time` of a session is traced with: `quality.level`, or where that is automatic, what the
/// session was recorded with; settings that are not at their defaults stay.
Settings replay_settings(const Settings& wanted, const Session& session, Nanoseconds time);

/// A frame's row of the session's stream "quality".
Session::QualitySample quality_sample(const Settings& settings, Nanoseconds time);

}  // namespace foveray::app
