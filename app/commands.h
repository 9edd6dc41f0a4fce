#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/settings.h"
#include "xr/client/runtime_choice.h"

/// What each command takes and does. A command returns when its work is done and throws Fault otherwise.
namespace foveray::app {

/// Frames first, first + 1, … end - 1 of a session.
struct FrameRange {
    std::uint64_t first = 0;
    std::uint64_t end = 0;

    bool operator==(const FrameRange&) const = default;
};

/// What view and replay share. Whatever is absent comes from the session, then from the runtime.
struct PictureOptions {
    std::optional<std::filesystem::path> scene;  // .gltf, .glb or scene file
    std::optional<std::string> camera;           // video file or image sequence
    std::optional<std::filesystem::path> calibration;
    std::optional<std::string> headset;  // a profile's name or file
    std::optional<std::uint32_t> gpu;    // index into vkEnumeratePhysicalDevices
    Settings settings;
};

struct ViewOptions : PictureOptions {
    xr::RuntimeChoice runtime = xr::RuntimeChoice::Auto;
    bool mirror = false;                          // a desktop window beside the headset
    std::optional<std::filesystem::path> record;  // session folder to write
};

struct ReplayOptions : PictureOptions {
    std::filesystem::path session;
    std::filesystem::path out;
    xr::RuntimeChoice runtime = xr::RuntimeChoice::Simulator;  // not Auto
    std::optional<FrameRange> frames;  // written frames; the ones before are simulated all the same
    bool reference = false;            // every viewport pixel a sample, no foveation
    bool json = false;
};

struct ImportOptions {
    std::vector<std::filesystem::path> files;
    std::string format;
    std::filesystem::path out;
    bool json = false;
};

struct DoctorOptions {
    bool json = false;
};

struct SettingsOptions {
    std::optional<std::string> headset;
    bool json = false;
};

ExitCode run_view(const ViewOptions& options);
ExitCode run_replay(const ReplayOptions& options);
ExitCode run_import(const ImportOptions& options);
/// Missing when foveray cannot run on this machine.
ExitCode run_doctor(const DoctorOptions& options);
ExitCode run_settings(const SettingsOptions& options);

}  // namespace foveray::app
