#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "render/engine/scene_types.h"
#include "render/shadows.h"
#include "render/shape_types.h"

namespace foveray::render {

/// What every ray of a frame runs: the one place that lists ray types, geometry types and ray-generation
/// shaders. Its shader table holds the geometries of one scene (AccelScene).
class RayPipeline {
  public:
    using Geometry = engine::SceneProgram::Geometry;
    using Range = engine::SceneRayTracer::Range;

    /// `slots`: frames in flight. The texture table must outlive the pipeline. `scene`: what the pipeline has
    /// shaders for is what is in it. `users`: of its user shapes.
    RayPipeline(const gpu::Device& device, const gpu::TextureTable& textures, std::uint32_t slots,
                const scene::Scene& scene, const UserShaders& users = {});

    /// A pipeline for this scene would be the same.
    bool suits(const scene::Scene& scene, const UserShaders& users) const;

    Geometry triangles(const shared::TriangleRecord& record) const;
    /// A real surface: found by surface rays, invisible itself.
    Geometry catcher(const shared::CatcherRecord& record) const;
    const ShapeTypes& shapes() const { return declared_.shapes; }

    /// Ray-generation shaders, by the stage that traces them.
    engine::RayGeneration fixation() const { return declared_.fixation; }
    engine::RayGeneration primary() const { return declared_.primary; }
    engine::RayGeneration probes() const { return declared_.probes; }
    ShadowStage::Entries shadows() const { return declared_.shadows; }
    engine::RayGeneration lighting() const { return declared_.lighting; }
    engine::RayGeneration bare_rays() const { return declared_.bare_rays; }

    engine::SceneRayTracer& tracer() { return tracer_; }
    const engine::SceneRayTracer& tracer() const { return tracer_; }

  private:
    struct Declared {
        engine::SceneProgram program;
        ShapeTypes shapes;
        std::set<scene::ShapeKind> kinds;
        UserShaders users;
        engine::GeometryType<shared::TriangleRecord> triangles;
        engine::GeometryType<shared::CatcherRecord> catchers;
        engine::RayGeneration fixation, probes, primary;
        ShadowStage::Entries shadows;
        engine::RayGeneration lighting, bare_rays;
    };
    static Declared declare(const scene::Scene& scene, const UserShaders& users);

    RayPipeline(const gpu::Device& device, const gpu::TextureTable& textures, std::uint32_t slots,
                Declared declared);

    Declared declared_;
    engine::SceneRayTracer tracer_;
};

}  // namespace foveray::render
