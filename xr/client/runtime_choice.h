#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace foveray::xr {

enum class RuntimeChoice { Auto, System, Simulator };

/// What the simulated headset is told, through its environment variables (docs/simulator.md).
struct SimulatorOptions {
    std::string profile = "ci";
    std::filesystem::path session;  // script; empty: a still head
    bool virtual_time = false;
    std::filesystem::path capture;  // folder for pictures; empty: none
    std::optional<std::pair<std::uint64_t, std::uint64_t>> capture_frames;  // [first, second)
    std::optional<std::uint32_t> gpu;
};

/// The manifest of the simulated headset beside the program. Throws Fault(Missing) when it is not there.
std::filesystem::path simulator_manifest();
/// Points the loader at the simulated headset and sets its variables; before an instance is made.
void use_simulator(const SimulatorOptions& options);
/// The manifest that the loader would take by itself (XR_RUNTIME_JSON, then the usual folders); empty: none.
std::filesystem::path system_runtime_manifest();

}  // namespace foveray::xr
