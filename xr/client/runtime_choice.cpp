#include "xr/client/runtime_choice.h"

#include <cstdlib>
#include <vector>

#include "base/error.h"

namespace foveray::xr {
namespace {

namespace fs = std::filesystem;

constexpr const char* manifest_name = "foveray_openxr_simulator.json";

fs::path environment_path(const char* name) {
    const char* value = std::getenv(name);
    return value ? fs::path(value) : fs::path();
}

void set_or_clear(const char* name, const std::string& value) {
    if (value.empty()) {
        ::unsetenv(name);
    } else {
        ::setenv(name, value.c_str(), 1);
    }
}

}  // namespace

fs::path simulator_manifest() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
    std::vector<fs::path> candidates = {environment_path("FOVERAY_SIMULATOR_MANIFEST"),
                                        program / manifest_name, program / "../lib/foveray" / manifest_name,
                                        program / "../share/openxr/1" / manifest_name};
    // In a build tree programs lie some folders below its root.
    for (fs::path folder = program; folder != folder.root_path(); folder = folder.parent_path()) {
        candidates.push_back(folder / "xr/simulator" / manifest_name);
        if (fs::exists(folder / "CMakeCache.txt")) break;
    }
    for (const fs::path& candidate : candidates) {
        if (!candidate.empty() && fs::exists(candidate, error)) return fs::canonical(candidate);
    }
    throw_missing("simulated headset", std::string(manifest_name) + " is not beside the program",
                  "build the target foveray, or set FOVERAY_SIMULATOR_MANIFEST");
}

void use_simulator(const SimulatorOptions& options) {
    set_or_clear("XR_RUNTIME_JSON", simulator_manifest().string());
    set_or_clear("FOVERAY_SIMULATOR_PROFILE", options.profile);
    set_or_clear("FOVERAY_SIMULATOR_SESSION", options.session.string());
    set_or_clear("FOVERAY_SIMULATOR_TIME", options.virtual_time ? "virtual" : "real");
    set_or_clear("FOVERAY_SIMULATOR_CAPTURE", options.capture.string());
    std::string frames;
    if (options.capture_frames) {
        frames = std::to_string(options.capture_frames->first) + ":" +
                 std::to_string(options.capture_frames->second);
    }
    set_or_clear("FOVERAY_SIMULATOR_CAPTURE_FRAMES", frames);
    set_or_clear("FOVERAY_SIMULATOR_GPU", options.gpu ? std::to_string(*options.gpu) : "");
}

fs::path system_runtime_manifest() {
    if (const fs::path chosen = environment_path("XR_RUNTIME_JSON"); !chosen.empty()) return chosen;
    fs::path config = environment_path("XDG_CONFIG_HOME");
    if (config.empty()) config = environment_path("HOME") / ".config";
    for (const fs::path& folder : {config, fs::path("/etc/xdg"), fs::path("/usr/local/etc"), fs::path("/etc"),
                                   fs::path("/usr/local/share"), fs::path("/usr/share")}) {
        const fs::path manifest = folder / "openxr/1/active_runtime.json";
        std::error_code error;
        if (fs::exists(manifest, error)) return manifest;
    }
    return {};
}

}  // namespace foveray::xr
