#include "xr/simulator/options.h"

#include <charconv>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <unistd.h>

#include "base/error.h"
#include "xr/simulator/control/control_path.h"

namespace foveray::simulator {
namespace {

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

template <typename Number>
bool parse(std::string_view text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size();
}

void read_frames(const std::string& text, Options& options) {
    const std::size_t colon = text.find(':');
    if (colon != std::string::npos &&
        parse(std::string_view(text).substr(0, colon), options.first_captured_frame) &&
        parse(std::string_view(text).substr(colon + 1), options.end_captured_frame) &&
        options.first_captured_frame <= options.end_captured_frame) {
        return;
    }
    throw_bad_input("FOVERAY_SIMULATOR_CAPTURE_FRAMES=" + text, "is no range of frames",
                    "write A:B for the frames from A up to B, B left out");
}

CaptureFormat read_capture_format() {
    const std::string format = variable("FOVERAY_SIMULATOR_CAPTURE_FORMAT");
    if (format.empty() || format == "png") return CaptureFormat::Png;
    if (format == "raw") return CaptureFormat::Raw;
    throw_bad_input("FOVERAY_SIMULATOR_CAPTURE_FORMAT=" + format, "is no format of captures",
                    "use png or raw");
}

bool read_window() {
    const std::string window = variable("FOVERAY_SIMULATOR_WINDOW");
    if (window.empty() || window == "0") return false;
    if (window == "1") return true;
    throw_bad_input("FOVERAY_SIMULATOR_WINDOW=" + window, "is neither 1 nor 0", "use 1 for a window");
}

/// KIND or KIND:SEED.
Pattern read_pattern(const std::string& text) {
    const std::string_view name = std::string_view(text).substr(0, text.find(':'));
    std::uint64_t seed = 0;
    const bool has_seed = name.size() < text.size();
    if (!has_seed || parse(std::string_view(text).substr(name.size() + 1), seed)) {
        if (name == "static") return {Pattern::Kind::Static, seed};
        if (name == "sweep") return {Pattern::Kind::Sweep, seed};
        if (name == "saccades") return {Pattern::Kind::Saccades, seed};
    }
    throw_bad_input("FOVERAY_SIMULATOR_PATTERN=" + text, "is no pattern",
                    "use static, sweep or saccades, and a seed if you like: saccades:7");
}

/// noise=DEGREES,latency=MS,blinks=A_MINUTE,blink=MS,seed=N, any of them.
GazeOptions read_gaze(const std::string& text) {
    GazeOptions gaze;
    const auto fail = [&](const std::string& what) {
        throw_bad_input(
            "FOVERAY_SIMULATOR_GAZE=" + text, what,
            "use any of noise=0 to 45 (degrees), latency=0 to 900 (ms), blinks=0 to 60 (a minute), "
            "blink=20 to 450 (ms), seed=N, with commas between them");
    };
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) {
        const std::size_t equals = std::min(part.find('='), part.size());
        const std::string_view name = std::string_view(part).substr(0, equals);
        const std::string_view value = std::string_view(part).substr(std::min(equals + 1, part.size()));
        const auto number = [&](double least, double most) {
            double read = 0.0;
            if (!parse(value, read) || !(read >= least && read <= most))
                fail("'" + part + "' is out of range");
            return read;
        };
        if (name == "noise") {
            gaze.noise = number(0.0, 45.0);
        } else if (name == "latency") {
            gaze.latency = from_seconds(1e-3 * number(0.0, 900.0));
        } else if (name == "blinks") {
            gaze.blinks = number(0.0, 60.0);
        } else if (name == "blink") {
            gaze.blink = from_seconds(1e-3 * number(20.0, 450.0));
        } else if (name != "seed") {
            fail("'" + part + "' is unknown");
        } else if (!parse(value, gaze.seed)) {
            fail("'" + part + "' is no seed");
        }
    }
    return gaze;
}

/// Stepped time and the window need a socket.
std::filesystem::path control_socket(TimeMode time, bool has_window) {
    const std::string control = variable("FOVERAY_SIMULATOR_CONTROL");
    if (control == "1" || (control.empty() && (time == TimeMode::Stepped || has_window)))
        return control_socket_path(getpid());
    return control;
}

}  // namespace

std::filesystem::path faults_file() {
    if (const std::string file = variable("FOVERAY_SIMULATOR_FAULTS"); !file.empty()) return file;
    const std::string session = variable("FOVERAY_SIMULATOR_SESSION");
    const std::filesystem::path file = std::filesystem::path(session) / "faults.csv";
    std::error_code ignored;
    return !session.empty() && std::filesystem::exists(file, ignored) ? file : std::filesystem::path();
}

TimeMode time_mode() {
    const std::string time = variable("FOVERAY_SIMULATOR_TIME");
    if (time == "virtual") return TimeMode::Virtual;
    if (time == "stepped") return TimeMode::Stepped;
    if (time.empty() || time == "real") return TimeMode::Real;
    throw_bad_input("FOVERAY_SIMULATOR_TIME=" + time, "is no kind of time", "use virtual, real or stepped");
}

Options read_options() {
    Options options;
    options.profile = variable("FOVERAY_SIMULATOR_PROFILE");
    options.session = variable("FOVERAY_SIMULATOR_SESSION");
    options.faults = faults_file();
    options.capture = variable("FOVERAY_SIMULATOR_CAPTURE");
    options.timing = variable("FOVERAY_SIMULATOR_TIMING");
    options.capture_format = read_capture_format();
    options.background = parse_background(variable("FOVERAY_SIMULATOR_BACKGROUND"));
    options.window = read_window();
    options.time = time_mode();
    if (const std::string pattern = variable("FOVERAY_SIMULATOR_PATTERN"); !pattern.empty()) {
        options.pattern = read_pattern(pattern);
        if (!options.session.empty())
            throw_bad_input("FOVERAY_SIMULATOR_PATTERN=" + pattern, "has no place beside a session",
                            "unset FOVERAY_SIMULATOR_SESSION or this one");
    }
    options.gaze = read_gaze(variable("FOVERAY_SIMULATOR_GAZE"));
    options.control = control_socket(options.time, options.window);
    if (const std::string frames = variable("FOVERAY_SIMULATOR_CAPTURE_FRAMES"); !frames.empty()) {
        read_frames(frames, options);
    }
    if (const std::string gpu = variable("FOVERAY_SIMULATOR_GPU"); !gpu.empty()) {
        if (!parse(gpu, options.gpu.emplace())) {
            throw_bad_input("FOVERAY_SIMULATOR_GPU=" + gpu, "is no number",
                            "give the device's place in Vulkan's list, counted from 0");
        }
    }
    return options;
}

}  // namespace foveray::simulator
