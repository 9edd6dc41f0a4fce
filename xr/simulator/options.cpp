#include "xr/simulator/options.h"

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "base/error.h"

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
