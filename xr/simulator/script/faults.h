#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string_view>
#include <vector>

#include "base/time.h"
#include "xr/simulator/api/failing_calls.h"

namespace foveray::simulator {

enum class FaultKind {
    Exit,
    SessionPause,
    SessionLoss,
    SessionLossPending,
    InstanceLoss,
    InstanceLossPending,
    Recentre,
    FocusLost,
    FocusGained,
    VisibilityLost,
    VisibilityGained,
    UserAbsent,
    UserPresent,
    HeadTrackingLost,
    HeadTrackingGained,
    PositionTrackingLost,
    PositionTrackingGained,
    OrientationTrackingLost,
    OrientationTrackingGained,
    GazeTrackingLost,
    GazeTrackingGained,
    FormFactorLost,
    FormFactorGained,
    MaskRemoved,
    MaskRestored,
    SlowCompositor,
    SwapchainTimeout,
    FailingCall,
};

/// What happens to the headset at a session time: a line of faults.csv or events.csv, or a command.
struct ScriptedFault {
    /// Before all times: holds while the instance is made.
    static constexpr Nanoseconds start = -1;

    Nanoseconds time = 0;
    FaultKind kind = FaultKind::Exit;
    Nanoseconds span = 0;     // until a pending loss; of the slow compositor's frames
    std::uint32_t count = 0;  // of swapchain time-outs
    FailingCall call;
};

/// They need a session: from the start on means its first frame.
bool is_of_session(FaultKind kind);
/// They happen once, to the instance.
bool is_of_instance(FaultKind kind);

/// `name` is one of those in docs/simulator.md.
bool is_fault_name(std::string_view name);
/// Throws Fault(BadInput) saying what is wrong with the name or the value at `where`.
ScriptedFault parse_fault(Nanoseconds time, std::string_view name, std::string_view value,
                          const std::string& where);
/// Whether the fault of that name takes a value.
bool takes_value(std::string_view name);

/// By time. frame_period turns frames into times. Throws Fault(BadInput) naming file, line and remedy.
std::vector<ScriptedFault> read_faults(const std::filesystem::path& file, Nanoseconds frame_period);
/// The first call reads the script's faults from `start` on that functions without an instance have.
void arm_failures_from_start();

/// What the faults up to some time leave.
struct Condition {
    bool focused = true, visible = true, user_present = true;
    bool head_tracked = true, form_factor_available = true, has_visibility_mask = true;
    std::optional<Nanoseconds> position_lost, orientation_lost, gaze_lost;  // since when
    Nanoseconds compositor_frame = 0;  // how long the compositor takes; 0: it keeps pace
};

/// All faults of a session by time. Safe to use from any thread.
class Faults {
  public:
    explicit Faults(std::vector<ScriptedFault> faults = {});

    void add(const ScriptedFault& fault);
    Condition at(Nanoseconds time) const;
    /// In (after, until].
    std::vector<ScriptedFault> between(Nanoseconds after, Nanoseconds until) const;
    /// Of the last recentring at or before `time`; 0 before any.
    Nanoseconds last_recentring(Nanoseconds time) const;

  private:
    mutable std::mutex mutex_;
    std::vector<ScriptedFault> faults_;
};

}  // namespace foveray::simulator
