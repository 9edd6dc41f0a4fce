#include "xr/simulator/script.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "xr/simulator/verify.h"

namespace foveray::simulator {

std::optional<Script::EventKind> Script::event_kind(std::string_view name) {
    static constexpr std::pair<std::string_view, EventKind> names[] = {
        {"exit", EventKind::Exit},
        {"session_loss", EventKind::SessionLoss},
        {"session_pause", EventKind::SessionPause},
        {"focus_lost", EventKind::FocusLost},
        {"focus_gained", EventKind::FocusGained},
        {"visibility_lost", EventKind::VisibilityLost},
        {"visibility_gained", EventKind::VisibilityGained},
        {"head_tracking_lost", EventKind::HeadLost},
        {"head_tracking_gained", EventKind::HeadGained},
        {"visibility_mask_removed", EventKind::MaskRemoved},
        {"visibility_mask_restored", EventKind::MaskRestored},
        {"user_absent", EventKind::UserAbsent},
        {"user_present", EventKind::UserPresent},
        {"recenter", EventKind::Recentre},
    };
    for (const auto& [known, kind] : names) {
        if (known == name) return kind;
    }
    return std::nullopt;
}

Script::Script(HeadsetProfile profile) : profile_(std::move(profile)) {}

Script::Script(HeadsetProfile profile, foveray::Session session)
    : profile_(std::move(profile)),
      session_(std::move(session)),
      hands_(session_.folder),
      has_session_(true) {
    std::set<std::string> unknown;
    for (const foveray::Session::Event& event : session_.events) {
        if (const auto kind = event_kind(event.name)) {
            events_.push_back({event.time, *kind});
        } else if (unknown.insert(event.name).second) {
            report((session_.folder / "events.csv").string() + ": event '" + event.name +
                   "' is left to the client; docs/simulator.md lists those that the headset plays");
        }
    }
}

double Script::rate_hz() const { return has_session_ ? session_.rate_hz : profile_.rate_hz; }

bool Script::ended(std::uint64_t frame_index) const { return has_session_ && frame_index >= session_.frames; }

Script::Head Script::head_at(Nanoseconds time) const {
    Head head{session_.head_at(time), true};
    for (const Event& event : events_) {
        if (event.time > time) break;
        if (event.kind == EventKind::HeadLost) head.tracked = false;
        if (event.kind == EventKind::HeadGained) head.tracked = true;
    }
    return head;
}

GazeSample Script::gaze_at(Nanoseconds time) const {
    GazeSample gaze;
    if (!profile_.eye_tracking) return gaze;
    if (!session_.gaze.empty()) return session_.gaze_at(time);
    gaze.time = time;
    gaze.valid = true;
    return gaze;
}

std::optional<GazeSample> Script::rendering_gaze_at(Nanoseconds time) const {
    const auto& samples = session_.gaze;
    if (!profile_.eye_tracking) return std::nullopt;
    if (samples.empty()) return gaze_at(time);
    const auto end = std::upper_bound(samples.begin(), samples.end(), time,
                                      [](Nanoseconds t, const GazeSample& s) { return t < s.time; });
    const auto found = std::find_if(std::make_reverse_iterator(end), samples.rend(),
                                    [](const GazeSample& s) { return s.valid; });
    if (found == samples.rend()) return std::nullopt;
    return *found;
}

std::optional<HandJoints> Script::hand_at(int hand, Nanoseconds time) const {
    if (!hands_.empty()) {
        const HandJoints* joints = hands_.at(hand, time);
        return joints ? std::optional(*joints) : std::nullopt;
    }
    const ControllerState controller = controller_at(hand, time);
    if (!controller.valid) return std::nullopt;
    return hand_round_controller(hand, controller);
}

bool Script::has_controller(int hand) const {
    return std::ranges::any_of(session_.controllers, [&](const auto& sample) { return sample.hand == hand; });
}

ControllerState Script::controller_at(int hand, Nanoseconds time) const {
    return session_.controller_at(hand, time);
}

Script::Presence Script::presence_at(Nanoseconds time) const {
    bool focused = true, visible = true;
    for (const Event& event : events_) {
        if (event.time > time) break;
        if (event.kind == EventKind::FocusLost) focused = false;
        if (event.kind == EventKind::FocusGained) focused = true;
        if (event.kind == EventKind::VisibilityLost) visible = false;
        if (event.kind == EventKind::VisibilityGained) visible = true;
    }
    if (!visible) return Presence::Hidden;
    return focused ? Presence::Focused : Presence::Visible;
}

bool Script::has_happened(EventKind kind, Nanoseconds time) const {
    return std::ranges::any_of(events_,
                               [&](const Event& event) { return event.time <= time && event.kind == kind; });
}

bool Script::exit_asked_at(Nanoseconds time) const { return has_happened(EventKind::Exit, time); }

bool Script::session_lost_at(Nanoseconds time) const { return has_happened(EventKind::SessionLoss, time); }

bool Script::paused(Nanoseconds after, Nanoseconds until) const {
    return std::ranges::any_of(events_, [&](const Event& event) {
        return event.kind == EventKind::SessionPause && event.time > after && event.time <= until;
    });
}

bool Script::user_present_at(Nanoseconds time) const {
    bool present = true;
    for (const Event& event : events_) {
        if (event.time > time) break;
        if (event.kind == EventKind::UserAbsent) present = false;
        if (event.kind == EventKind::UserPresent) present = true;
    }
    return present;
}

bool Script::has_visibility_mask_at(Nanoseconds time) const {
    bool has_mask = true;
    for (const Event& event : events_) {
        if (event.time > time) break;
        if (event.kind == EventKind::MaskRemoved) has_mask = false;
        if (event.kind == EventKind::MaskRestored) has_mask = true;
    }
    return has_mask;
}

Pose Script::upright_head_at(Nanoseconds time) const {
    const Pose head = session_.head_at(time);
    const vec3 forward = head.orientation * vec3(0.0f, 0.0f, -1.0f);
    Pose upright{quat(1.0f, 0.0f, 0.0f, 0.0f), head.position};
    if (std::hypot(forward.x, forward.z) > 1e-3f) {
        upright.orientation = glm::angleAxis(std::atan2(-forward.x, -forward.z), vec3(0.0f, 1.0f, 0.0f));
    }
    return upright;
}

Pose Script::stage_from_local_at(Nanoseconds time) const {
    const auto recentred = recentrings(-1, time);
    return upright_head_at(recentred.empty() ? 0 : recentred.back());
}

Pose Script::stage_from_local_floor_at(Nanoseconds time) const {
    Pose floor = stage_from_local_at(time);
    floor.position.y = 0.0f;
    return floor;
}

std::vector<Nanoseconds> Script::recentrings(Nanoseconds after, Nanoseconds until) const {
    std::vector<Nanoseconds> times;
    for (const Event& event : events_) {
        if (event.kind == EventKind::Recentre && event.time > after && event.time <= until) {
            times.push_back(event.time);
        }
    }
    return times;
}

}  // namespace foveray::simulator
