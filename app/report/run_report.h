#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/math.h"
#include "base/settings.h"
#include "base/time.h"

namespace foveray::app {

/// What one frame took. A row of metrics.csv.
struct FrameMetrics {
    struct Rays {
        std::uint64_t primary = 0, shadow = 0, reflection = 0, transparent = 0, probe = 0, occlusion = 0;
        std::uint64_t total() const { return primary + shadow + reflection + transparent + probe + occlusion; }
    };
    std::uint64_t index = 0;
    Nanoseconds display_time = 0;
    bool gaze_valid = false;
    float gaze_yaw_degrees = 0.0f;    // in the head's frame, to the right positive
    float gaze_pitch_degrees = 0.0f;  // up positive
    /// Where the gaze meets the merged picture of the left and the right eye; (0, 0) is the top left corner,
    /// (1, 1) the bottom right one. Absent when it is outside, or unknown.
    std::array<std::optional<vec2>, 2> gaze_mark;
    Rays rays;
    uvec2 polar_size{0};                                 // of one eye's polar image; 0 with --reference
    std::vector<std::pair<std::string, double>> stages;  // name and GPU milliseconds, in frame order
    double cpu_ms = 0.0;

    double gpu_ms() const;
};

/// What was run, where and how.
struct RunInfo {
    std::string title;  // the session's name
    std::string session, scene, camera;
    std::string headset;
    double rate_hz = 0.0;
    std::vector<uvec2> view_sizes;  // pixels, as in Frame::views
    bool reference = false;
    std::string device, driver, openxr_runtime;
    Settings settings;
};

/// Stages that any frame names, in the order of their first appearance.
std::vector<std::string> stage_names(std::span<const FrameMetrics> frames);

/// OUT/metrics.csv; a stage that a frame does not name has 0 ms there. Throws Fault(BadInput) when the file
/// cannot be written, like the functions below.
void write_metrics(const std::filesystem::path& file, std::span<const FrameMetrics> frames);

/// The contents of OUT/summary.json; docs/report.md explains them.
Json summarize(const RunInfo& run, std::span<const FrameMetrics> frames);

/// Writes metrics.csv, summary.json and report.html into `folder`. The page shows what it finds there:
/// frames/frame_NNNNN_left.png and …_right.png, and video.mp4, by relative path.
void write_report(const std::filesystem::path& folder, const RunInfo& run,
                  std::span<const FrameMetrics> frames);

}  // namespace foveray::app
