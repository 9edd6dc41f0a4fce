#include "app/session_recorder.h"

#include <algorithm>
#include <utility>

namespace foveray::app {

SessionRecorder::SessionRecorder(const std::filesystem::path& folder, Session header)
    : folder_(folder, ""), session_(std::move(header)) {
    session_.frames = 0;
    session_.head.clear();
    session_.gaze.clear();
    session_.controllers.clear();
    session_.events.clear();
    session_.quality.clear();
}

void SessionRecorder::set_headset(const HeadsetProfile& profile) {
    const std::filesystem::path file = folder_.path() / "headset.json";
    write_headset_profile(file, profile);
    session_.headset = file.string();
}

void SessionRecorder::add(const Frame& frame) {
    // A slow machine skips display periods: the recording lasts as long as it did, not as many frames as were
    // drawn.
    // Runtimes tell a longer period while they are too slow themselves.
    period_ = period_ == 0 ? frame.period : std::min(period_, frame.period);
    session_.frames = static_cast<std::uint64_t>((frame.time + period_ / 2) / period_) + 1;
    session_.rate_hz = static_cast<double>(nanoseconds_per_second) / static_cast<double>(period_);
    note(frame.time, head_tracked_, frame.head_valid, "head_tracking");
    if (frame.head_valid) {
        note(frame.time, position_tracked_, frame.head_position_tracked, "position_tracking");
        note(frame.time, orientation_tracked_, frame.head_orientation_tracked, "orientation_tracking");
        session_.head.push_back({frame.time, frame.stage_from_head});
    }
    if (frame.has_eye_tracking) {
        const Pose head_from_stage = inverse(frame.stage_from_head);
        GazeSample gaze = frame.gaze;
        // Trackers stamp on the runtime's clock; a session's starts with its first frame.
        gaze.time = gaze.valid ? gaze.time - (frame.display_time - frame.time) : frame.time;
        if (!session_.gaze.empty()) gaze.time = std::max(gaze.time, session_.gaze.back().time);
        gaze.origin = transform_point(head_from_stage, gaze.origin);
        gaze.direction = transform_direction(head_from_stage, gaze.direction);
        session_.gaze.push_back(gaze);
    }
    for (int hand = 0; hand < 2; ++hand) {
        const ControllerState& state = frame.controllers[hand];
        if (state.valid) session_.controllers.push_back({frame.time, hand, state});
    }
}

void SessionRecorder::note(Nanoseconds time, bool& was_tracked, bool is_tracked, const std::string& what) {
    if (std::exchange(was_tracked, is_tracked) != is_tracked)
        session_.events.push_back({time, what + (is_tracked ? "_gained" : "_lost"), ""});
}

void SessionRecorder::add(const Session::QualitySample& quality) {
    if (!session_.quality.empty()) {
        Session::QualitySample same = session_.quality.back();
        same.time = quality.time;
        if (same == quality) return;
    }
    session_.quality.push_back(quality);
}

void SessionRecorder::add_scene_change(const Frame& frame) {
    session_.events.push_back({frame.time, std::string(scene_changed_event), ""});
}

void SessionRecorder::finish() {
    if (session_.frames == 0 || !knows_headset()) return;
    write_session(folder_.path(), session_);
    folder_.commit();
}

}  // namespace foveray::app
