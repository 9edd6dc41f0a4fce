#pragma once

#include <map>
#include <string>

#include "render/ray_pipeline.h"
#include "render/user_shapes/probe.h"

namespace foveray::user_shapes {

/// Makes users' shapes ready to be seen: probes them in a child process and compiles them. What it found good
/// it does not try again. One thread at a time.
class ShapeStore {
  public:
    explicit ShapeStore(const ProbeOptions& options = {}) : options_(options) {}

    /// Of all user shapes of a scene. Throws Fault(BadInput) with the reason why one cannot be shown.
    render::UserShaders prepare(const scene::Scene& scene);
    /// Of one whose file has changed since the scene was loaded.
    render::UserShader prepare(const scene::Scene& scene, scene::UserShapeId id,
                               const scene::UserShapeCode& code);

  private:
    ProbeOptions options_;
    std::map<std::string, render::UserShader> good_;  // by what the probe was asked
};

}  // namespace foveray::user_shapes
