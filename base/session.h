#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/frame.h"
#include "base/gaze.h"
#include "base/math.h"
#include "base/time.h"

namespace foveray {

/// What happened in a headset over some seconds: a folder with session.json and one CSV per stream.
/// docs/session-format.md is the reference.
struct Session {
    struct HeadSample {
        Nanoseconds time = 0;
        Pose stage_from_head;
    };
    struct ControllerSample {
        Nanoseconds time = 0;
        int hand = 0;  // 0 left, 1 right
        ControllerState state;
    };
    /// See docs/session-format.md for the names.
    struct Event {
        Nanoseconds time = 0;
        std::string name;
        std::string value;
    };

    /// What frames from `time` on were traced with: the settings of the same names.
    struct QualitySample {
        Nanoseconds time = 0;
        float resolution_scale = 1.0f;
        int shadow_samples = 1, ambient_occlusion_samples = 1, probe_rays = 64, second_ray_depth = 1;

        bool operator==(const QualitySample&) const = default;
    };

    std::filesystem::path folder;  // empty for one made in memory
    std::string headset = "ci";  // profile it was recorded with; a .json file's path is absolute once loaded
    double rate_hz = 0.0;        // frames a second of the recording
    std::uint64_t frames = 0;
    // What the session was recorded with; paths absolute once loaded. A command line overrides them.
    std::optional<std::filesystem::path> scene, camera, calibration;

    std::vector<HeadSample> head;  // each stream ordered by time; times start at about 0
    std::vector<GazeSample> gaze;  // in the head's frame
    std::vector<ControllerSample> controllers;
    std::vector<Event> events;
    std::vector<QualitySample> quality;

    Nanoseconds duration() const;

    /// Interpolated; held before the first and after the last sample. Identity at 1.6 m without samples.
    Pose head_at(Nanoseconds time) const;
    /// The newest sample at or before `time` (trackers are slower than displays); invalid before the first.
    GazeSample gaze_at(Nanoseconds time) const;
    ControllerState controller_at(int hand, Nanoseconds time) const;
    /// The newest sample at or before `time`; empty before the first.
    std::optional<QualitySample> quality_at(Nanoseconds time) const;
};

/// The scene was edited, and shown as it was then from this time on.
constexpr std::string_view scene_changed_event = "scene_changed";

/// Throws Fault(BadInput) naming file, line and remedy: missing files, bad numbers, NaN poses, times that go
/// backwards, a version from the future.
Session read_session(const std::filesystem::path& folder);
/// Writes the folder's files; paths become relative to it where they can.
void write_session(const std::filesystem::path& folder, const Session& session);

}  // namespace foveray
