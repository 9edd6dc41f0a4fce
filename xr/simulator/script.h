#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/headset_profile.h"
#include "base/session.h"
#include "xr/simulator/hands.h"

namespace foveray::simulator {

/// What happens to the simulated headset, as pure functions of session time: poses, gaze, controllers and
/// events. Without a session, or for a stream that it lacks, the head stands still at 1.6 m and looks
/// straight ahead.
class Script {
  public:
    enum class Presence { Focused, Visible, Hidden };

    struct Head {
        Pose stage_from_head;
        bool tracked = true;
    };

    explicit Script(HeadsetProfile profile);
    /// Events that the simulator does not know stay the client's; they are reported once.
    Script(HeadsetProfile profile, foveray::Session session);

    const HeadsetProfile& profile() const { return profile_; }
    /// Frames a second: the session's, or else the profile's.
    double rate_hz() const;
    /// The session has no frame of that index.
    bool ended(std::uint64_t frame_index) const;

    Head head_at(Nanoseconds time) const;
    /// In the head's frame; the newest measurement at or before `time`.
    GazeSample gaze_at(Nanoseconds time) const;
    /// Where gaze-contingent views look: the last valid gaze, held through blinks; nothing before any.
    std::optional<GazeSample> rendering_gaze_at(Nanoseconds time) const;
    /// The script has that controller at any time.
    bool has_controller(int hand) const;
    ControllerState controller_at(int hand, Nanoseconds time) const;

    /// The stream hands.csv, or without it hands round the controllers; nothing while the hand is not seen.
    std::optional<HandJoints> hand_at(int hand, Nanoseconds time) const;

    Presence presence_at(Nanoseconds time) const;
    bool exit_asked_at(Nanoseconds time) const;
    bool session_lost_at(Nanoseconds time) const;
    /// The session is asked to pause in (after, until].
    bool paused(Nanoseconds after, Nanoseconds until) const;
    /// Somebody wears the headset.
    bool user_present_at(Nanoseconds time) const;
    /// The profile's hidden area is told to clients.
    bool has_visibility_mask_at(Nanoseconds time) const;
    /// The local space: upright, at the head's place when the session began or was last recentred.
    Pose stage_from_local_at(Nanoseconds time) const;
    /// The same place and heading on the stage's floor.
    Pose stage_from_local_floor_at(Nanoseconds time) const;
    /// Times of recentring in (after, until].
    std::vector<Nanoseconds> recentrings(Nanoseconds after, Nanoseconds until) const;

  private:
    enum class EventKind {
        Exit,
        SessionLoss,
        SessionPause,
        FocusLost,
        FocusGained,
        VisibilityLost,
        VisibilityGained,
        HeadLost,
        HeadGained,
        MaskRemoved,
        MaskRestored,
        UserAbsent,
        UserPresent,
        Recentre
    };
    struct Event {
        Nanoseconds time;
        EventKind kind;
    };
    static std::optional<EventKind> event_kind(std::string_view name);
    bool has_happened(EventKind kind, Nanoseconds time) const;
    Pose upright_head_at(Nanoseconds time) const;

    HeadsetProfile profile_;
    foveray::Session session_;
    HandStream hands_;
    bool has_session_ = false;
    std::vector<Event> events_;  // by time
};

}  // namespace foveray::simulator
