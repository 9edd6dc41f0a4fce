#include "xr/simulator/script/script.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "xr/simulator/api/verify.h"
#include "xr/simulator/frame_clock.h"
#include "xr/simulator/placement.h"

namespace foveray::simulator {

namespace {

/// The events of a session that are the headset's.
std::vector<ScriptedFault> read_events(const foveray::Session& session) {
    const std::string file = (session.folder / "events.csv").string();
    std::vector<ScriptedFault> faults;
    std::set<std::string> unknown;
    for (const foveray::Session::Event& event : session.events) {
        if (is_fault_name(event.name)) {
            const std::string where = file + ": " + event.name + " at " + std::to_string(event.time) + " ns";
            faults.push_back(
                parse_fault(event.time, event.name, takes_value(event.name) ? event.value : "", where));
        } else if (unknown.insert(event.name).second) {
            report(file + ": event '" + event.name +
                   "' is left to the client; docs/simulator.md lists those that the headset plays");
        }
    }
    return faults;
}

std::vector<ScriptedFault> read_all_faults(const foveray::Session& session, const std::filesystem::path& file,
                                           Nanoseconds frame_period) {
    std::vector<ScriptedFault> faults = read_events(session);
    if (file.empty()) return faults;
    const auto others = read_faults(file, frame_period);
    faults.insert(faults.end(), others.begin(), others.end());
    return faults;
}

}  // namespace

Script::Script(HeadsetProfile profile, Sources sources)
    : profile_(std::move(profile)),
      has_session_(sources.session.has_value()),
      session_(std::move(sources.session).value_or(foveray::Session{})),
      hands_(has_session_ ? HandStream(session_.folder) : HandStream()),
      pattern_(sources.pattern),
      gaze_tracker_(sources.gaze, sources.pattern),
      faults_(read_all_faults(session_, sources.faults, frame_period(rate_hz()))) {}

double Script::rate_hz() const { return has_session_ ? session_.rate_hz : profile_.rate_hz; }

bool Script::ended(std::uint64_t frame_index) const { return has_session_ && frame_index >= session_.frames; }

Pose Script::true_head_at(Nanoseconds time) const {
    if (const auto commanded = overrides_.head_at(time)) return *commanded;
    return pattern_ ? pattern_->stage_from_head(time) : session_.head_at(time);
}

Script::Head Script::head_at(Nanoseconds time) const {
    const Condition condition = faults_.at(time);
    Head head{true_head_at(time), condition.head_tracked ? all_location_flags : 0};
    // What is lost stays as it was: known, but not measured.
    if (condition.position_lost) {
        head.stage_from_head.position = true_head_at(*condition.position_lost).position;
        head.flags &= ~XrSpaceLocationFlags{XR_SPACE_LOCATION_POSITION_TRACKED_BIT};
    }
    if (condition.orientation_lost) {
        head.stage_from_head.orientation = true_head_at(*condition.orientation_lost).orientation;
        head.flags &= ~XrSpaceLocationFlags{XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT};
    }
    return head;
}

GazeSample Script::gaze_at(Nanoseconds time) const {
    if (!profile_.eye_tracking || faults_.at(time).gaze_lost) return {};
    if (const auto commanded = overrides_.gaze_at(time)) return *commanded;
    return gaze_tracker_.at(session_, time);
}

std::optional<GazeSample> Script::rendering_gaze_at(Nanoseconds time) const {
    if (!profile_.eye_tracking) return std::nullopt;
    if (const auto lost = faults_.at(time).gaze_lost) {
        if (*lost <= 0) return std::nullopt;
        time = *lost - 1;
    }
    if (const auto commanded = overrides_.gaze_at(time); commanded && commanded->valid) return commanded;
    return gaze_tracker_.last_valid_at(session_, time);
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
    return overrides_.has_controller(hand) ||
           std::ranges::any_of(session_.controllers, [&](const auto& sample) { return sample.hand == hand; });
}

ControllerState Script::controller_at(int hand, Nanoseconds time) const {
    return overrides_.controller_at(hand, time, session_.controller_at(hand, time));
}

Script::Presence Script::presence_at(Nanoseconds time) const {
    const Condition condition = faults_.at(time);
    if (!condition.visible || !condition.user_present) return Presence::Hidden;
    return condition.focused ? Presence::Focused : Presence::Visible;
}

Pose Script::upright_head_at(Nanoseconds time) const {
    const Pose head = true_head_at(time);
    const vec3 forward = head.orientation * vec3(0.0f, 0.0f, -1.0f);
    Pose upright{quat(1.0f, 0.0f, 0.0f, 0.0f), head.position};
    if (std::hypot(forward.x, forward.z) > 1e-3f) {
        upright.orientation = glm::angleAxis(std::atan2(-forward.x, -forward.z), vec3(0.0f, 1.0f, 0.0f));
    }
    return upright;
}

Pose Script::stage_from_local_at(Nanoseconds time) const {
    return upright_head_at(faults_.last_recentring(time));
}

Pose Script::stage_from_local_floor_at(Nanoseconds time) const {
    Pose floor = stage_from_local_at(time);
    floor.position.y = 0.0f;
    return floor;
}

}  // namespace foveray::simulator
