#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "xr/simulator/display/background.h"
#include "xr/simulator/script/gaze_tracker.h"
#include "xr/simulator/script/pattern.h"

namespace foveray::simulator {

enum class TimeMode { Virtual, Real, Stepped };
enum class CaptureFormat { Png, Raw };

/// What the FOVERAY_SIMULATOR_* variables say; docs/simulator.md lists them.
struct Options {
    std::string profile;  // empty: the session's headset, or "ci"
    std::filesystem::path session, faults;
    std::optional<Pattern> pattern;
    GazeOptions gaze;
    TimeMode time = TimeMode::Real;
    std::filesystem::path control;  // socket; empty: none
    std::filesystem::path capture, timing;
    CaptureFormat capture_format = CaptureFormat::Png;
    std::uint64_t first_captured_frame = 0;
    std::uint64_t end_captured_frame = UINT64_MAX;
    std::optional<std::uint32_t> gpu;
    Background background;
    bool window = false;

    bool captures(std::uint64_t frame) const {
        return !capture.empty() && frame >= first_captured_frame && frame < end_captured_frame;
    }
};

/// The file with the script's faults: FOVERAY_SIMULATOR_FAULTS, or the session's faults.csv where it has one.
/// Empty: there is none.
std::filesystem::path faults_file();
/// Throws Fault(BadInput) naming the variable.
TimeMode time_mode();
Options read_options();

}  // namespace foveray::simulator
