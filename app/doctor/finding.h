#pragma once

#include <string>
#include <vector>

namespace foveray::app {

/// One thing that `foveray doctor` looked for.
struct Finding {
    enum class State {
        Good,
        Optional,  // not there, and only some uses need it
        Missing,   // not there, and foveray cannot do without
        Note,      // worth knowing
    };
    State state = State::Good;
    std::string subject, what;
    std::string remedy;  // a command or a step; empty when nothing is to be done
};

/// Loader, validation layer, and each device with what foveray misses on it. Missing when no device will do.
std::vector<Finding> find_vulkan();
/// The active runtime and the simulated headset, each asked for a headset. Missing when neither has one.
std::vector<Finding> find_openxr();
/// V4L2 devices below `devices`, with their names from `names` (normally /dev and /sys/class/video4linux).
std::vector<Finding> find_cameras(const std::string& devices, const std::string& names);
/// An H.264 encoder for the report's video.
std::vector<Finding> find_video_encoder();

}  // namespace foveray::app
