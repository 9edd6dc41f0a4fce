#pragma once

#include <cstdint>
#include <optional>

#include <openxr/openxr.h>

#include "base/headset_profile.h"
#include "base/session.h"
#include "xr/simulator/input/hands.h"
#include "xr/simulator/script/faults.h"
#include "xr/simulator/script/gaze_tracker.h"
#include "xr/simulator/script/overrides.h"

namespace foveray::simulator {

/// What happens to the simulated headset, as functions of session time: poses, gaze, controllers and faults.
/// Without a session, or for a stream that it lacks, the head stands still at 1.6 m and looks straight ahead.
class Script {
  public:
    enum class Presence { Focused, Visible, Hidden };

    struct Head {
        Pose stage_from_head;
        XrSpaceLocationFlags flags = 0;  // what the trackers know of it
    };

    struct Sources {
        std::optional<foveray::Session> session;
        std::optional<Pattern> pattern;  // in the place of a session's head and gaze
        GazeOptions gaze;
        std::filesystem::path faults;  // a file; empty: none
    };

    /// Events that the simulator does not know stay the client's; they are reported once. Throws
    /// Fault(BadInput).
    Script(HeadsetProfile profile, Sources sources);

    const HeadsetProfile& profile() const { return profile_; }
    /// Frames a second: the session's, or else the profile's.
    double rate_hz() const;
    /// The session has no frame of that index.
    bool ended(std::uint64_t frame_index) const;

    Head head_at(Nanoseconds time) const;
    /// In the head's frame; the newest measurement that is there at `time`.
    GazeSample gaze_at(Nanoseconds time) const;
    /// Where gaze-contingent views look: the last valid gaze, held through blinks; nothing before any.
    std::optional<GazeSample> rendering_gaze_at(Nanoseconds time) const;
    /// The script, or a command, has that controller at any time.
    bool has_controller(int hand) const;
    ControllerState controller_at(int hand, Nanoseconds time) const;

    /// The stream hands.csv, or without it hands round the controllers; nothing while the hand is not seen.
    std::optional<HandJoints> hand_at(int hand, Nanoseconds time) const;

    Overrides& overrides() { return overrides_; }
    Faults& faults() { return faults_; }
    const Faults& faults() const { return faults_; }
    /// What an absent wearer and the faults leave of a session's rights.
    Presence presence_at(Nanoseconds time) const;
    /// The local space: upright, at the head's place when the session began or was last recentred.
    Pose stage_from_local_at(Nanoseconds time) const;
    /// The same place and heading on the stage's floor.
    Pose stage_from_local_floor_at(Nanoseconds time) const;

  private:
    Pose true_head_at(Nanoseconds time) const;
    Pose upright_head_at(Nanoseconds time) const;

    HeadsetProfile profile_;
    bool has_session_;
    foveray::Session session_;
    HandStream hands_;
    std::optional<Pattern> pattern_;
    GazeTracker gaze_tracker_;
    Faults faults_;
    Overrides overrides_;
};

}  // namespace foveray::simulator
