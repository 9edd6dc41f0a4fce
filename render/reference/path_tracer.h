#pragma once

#include <cstdint>

#include "render/reference/tracer.h"

namespace foveray::reference {

/// Naive path tracing of diffuse surfaces: a surface reflects base colour × (1 - metallic) to all sides.
/// Light comes from area lights, emissive surfaces and the environment; punctual lights are left out.
class PathTracer {
  public:
    PathTracer(const scene::Scene& scene, const scene::SceneChanges& now);

    /// Irradiance by all light that does not come straight from an area light: bounced, emitted by surfaces,
    /// from the environment. `normal` has unit length. Equal arguments give equal results.
    dvec3 indirect_irradiance(dvec3 position, dvec3 normal, std::uint32_t paths) const;

  private:
    struct Random;
    dvec3 direct_irradiance(dvec3 position, dvec3 normal, Random& random) const;
    dvec3 radiance(Ray ray, Random& random) const;
    dvec3 environment(dvec3 direction) const;

    const scene::Scene* scene_;
    std::vector<scene::PlacedAreaLight> lights_;
    Tracer tracer_;
};

}  // namespace foveray::reference
