#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "render/scene/scene.h"

namespace foveray::user_shapes {

struct ProbeOptions {
    /// What the child runs, with the arguments `probe-shape`: its main() must call serve_probe first.
    std::filesystem::path program = "/proc/self/exe";
    std::optional<std::uint32_t> gpu;  // as gpu::DeviceOptions::index
    bool validation = false;
    std::chrono::milliseconds start_limit = std::chrono::minutes(1);  // until device and pipelines are ready
    std::chrono::milliseconds limit = std::chrono::seconds(2);        // of the probe frame
};

/// Runs a user's shape in a child process, with all values that the scene's objects give it, before anything
/// else does: a shape may hang or crash the device. Throws Fault(BadInput) with the reason why the shape
/// cannot be shown, compile errors among them.
void probe(const scene::Scene& scene, const scene::UserShape& user, scene::UserShapeId id,
           const ProbeOptions& options);

/// The child's side: if the program was started by `probe`, serves it and returns the exit code.
std::optional<int> serve_probe(int argc, const char* const* argv);

}  // namespace foveray::user_shapes
