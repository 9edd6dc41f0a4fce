#pragma once

#include <vector>

#include "render/engine/ray_tracer.h"
#include "shaders/tests/gpu/probe.h"

namespace foveray::gpu {

using ProbeProgram =
    engine::Program<shared::PROBE_RAY_TYPES, shared::WideRecord, shared::NarrowRecord, shared::ProbeSphereRecord>;
using ProbeTracer = engine::RayTracer<shared::PROBE_RAY_TYPES, shared::WideRecord, shared::NarrowRecord,
                                      shared::ProbeSphereRecord>;

/// Vertices on the GPU, three a triangle.
struct Triangles {
    Buffer positions, indices;
    std::uint32_t count = 0;

    Triangles(const Device& device, const std::vector<glm::vec3>& corners);
    TriangleGeometry geometry(bool opaque = true) const;
};

/// A triangle that a ray along -z through (x + 0.25, y + 0.25) meets at `z`, facing +z.
std::vector<glm::vec3> corner_triangle(float x, float y, float z);

/// Boxes on the GPU.
struct Boxes {
    Buffer boxes;
    std::uint32_t count = 0;

    Boxes(const Device& device, const std::vector<vk::AabbPositionsKHR>& all);
    BoxGeometry geometry() const { return {boxes.address(), count}; }
};

BottomLevel build_bottom_level(const Device& device, std::vector<AccelerationGeometry> geometries,
                               bool deforms = false);

/// A ray along -z from (x, y, 1) that sees everything.
shared::ProbeRay ray_at(float x, float y, std::uint32_t ray_type = 0);

/// Everything needed to ask a scene what rays meet.
class Probe {
  public:
    explicit Probe(const Device& device, std::uint32_t slots = 1);

    /// Builds the scene of these instances in the slot, traces the rays and waits.
    std::vector<shared::ProbeHit> trace(const std::vector<TopLevelInstance>& instances,
                                        const std::vector<shared::ProbeRay>& rays, std::uint32_t slot = 0);
    /// The same for a scene of one structure, whose `geometry_count` geometries are narrow ones.
    std::vector<shared::ProbeHit> trace(const BottomLevel& structure, std::uint32_t geometry_count,
                                        const std::vector<shared::ProbeRay>& rays);

    engine::GeometryType<shared::WideRecord> wide;
    engine::GeometryType<shared::NarrowRecord> narrow,
        sieve;  // sieve: its any-hit shader lets every second through
    engine::GeometryType<shared::ProbeSphereRecord> sphere;
    engine::RayGeneration probe, second;
    TextureTable textures;
    ProbeTracer tracer;
    TopLevel scene;

  private:
    ProbeProgram declare();

    const Device& device_;
};

}  // namespace foveray::gpu
