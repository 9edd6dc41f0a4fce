#include <algorithm>
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "app/doctor/finding.h"
#include "base/error.h"
#include "passthrough/capture/video_writer.h"

namespace foveray::app {
namespace {

namespace fs = std::filesystem;
using State = Finding::State;

}  // namespace

std::vector<Finding> find_cameras(const std::string& devices, const std::string& names) {
    std::vector<fs::path> cameras;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(devices, error)) {
        if (entry.path().filename().string().starts_with("video")) cameras.push_back(entry.path());
    }
    std::sort(cameras.begin(), cameras.end());
    std::vector<Finding> findings;
    for (const fs::path& camera : cameras) {
        std::string name;
        std::getline(std::ifstream(fs::path(names) / camera.filename() / "name"), name);
        if (::access(camera.c_str(), R_OK | W_OK) == 0) {
            findings.push_back({State::Good, "Camera " + camera.string(), name, ""});
        } else {
            findings.push_back({State::Optional, "Camera " + camera.string(), name + ", you may not open it",
                                "add yourself to the group video: adduser $USER video"});
        }
    }
    if (findings.empty()) {
        findings.push_back({State::Optional, "Cameras", "no V4L2 device; recorded video needs none",
                            "use --camera with a video file or an image sequence"});
    }
    return findings;
}

std::vector<Finding> find_video_encoder() {
    const fs::path file =
        fs::temp_directory_path() / ("foveray-doctor-" + std::to_string(::getpid()) + ".mp4");
    Finding finding{State::Good, "Video encoder", "H.264", ""};
    try {
        passthrough::VideoWriter writer(file, 64, 64, 30.0);
        for (int i = 0; i < 3; ++i) writer.write(Image(64, 64, 3));
        writer.finish();
    } catch (const Fault& fault) {
        finding = {State::Missing, "Video encoder", fault.what(),
                   "apt-get install libopencv-videoio-dev, with the distribution's FFmpeg and x264"};
    }
    std::error_code ignored;
    fs::remove(file, ignored);
    return {finding};
}

}  // namespace foveray::app
