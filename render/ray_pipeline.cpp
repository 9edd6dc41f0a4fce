#include "render/ray_pipeline.h"

#include <utility>

namespace foveray::render {

namespace {

std::set<scene::ShapeKind> kinds_of(const scene::Scene& scene) {
    std::set<scene::ShapeKind> kinds;
    for (const scene::Shape& shape : scene.shapes) kinds.insert(shape.kind);
    return kinds;
}

}  // namespace

RayPipeline::Declared RayPipeline::declare(const scene::Scene& scene, const UserShaders& users) {
    using engine::HitGroup;
    using engine::RayType;
    engine::SceneProgram program("scene", RayType{"surface", "render/surface.rmiss"},
                                 RayType{"shadow", "render/shadow.rmiss"});
    const ShapeTypes shapes(program, scene, users);
    Declared d{std::move(program), shapes, kinds_of(scene), users, {}, {}, {}, {}, {}, {}, {}, {}};
    d.triangles = d.program.add_geometry_type<shared::TriangleRecord>(
        "triangles", HitGroup{"render/surface.rchit", "render/surface.rahit", ""},
        HitGroup{"", "render/shadow.rahit", ""});
    d.catchers = d.program.add_geometry_type<shared::CatcherRecord>(
        "catchers", HitGroup{"render/catcher.rchit", "", ""}, HitGroup{"", "", ""});
    d.fixation = d.program.add_ray_generation("render/fixation.rgen");
    d.probes = d.program.add_ray_generation("render/probe_trace.rgen");
    d.primary = d.program.add_ray_generation("render/primary.rgen");
    d.shadows.shadows = d.program.add_ray_generation("render/shadows.rgen");
    d.shadows.penumbras = d.program.add_ray_generation("render/penumbras.rgen");
    d.shadows.penumbra_rays = d.program.add_ray_generation("render/penumbra_rays.rgen");
    d.lighting = d.program.add_ray_generation("render/lighting.rgen");
    d.bare_rays = d.program.add_ray_generation("render/bare_rays.rgen");
    return d;
}

RayPipeline::RayPipeline(const gpu::Device& device, const gpu::TextureTable& textures, std::uint32_t slots,
                         const scene::Scene& scene, const UserShaders& users)
    : RayPipeline(device, textures, slots, declare(scene, users)) {}

RayPipeline::RayPipeline(const gpu::Device& device, const gpu::TextureTable& textures, std::uint32_t slots,
                         Declared declared)
    : declared_(std::move(declared)), tracer_(device, textures, slots, declared_.program) {}

bool RayPipeline::suits(const scene::Scene& scene, const UserShaders& users) const {
    return declared_.kinds == kinds_of(scene) && declared_.users == users;
}

RayPipeline::Geometry RayPipeline::triangles(const shared::TriangleRecord& record) const {
    return engine::SceneProgram::geometry(declared_.triangles, record);
}

RayPipeline::Geometry RayPipeline::catcher(const shared::CatcherRecord& record) const {
    return engine::SceneProgram::geometry(declared_.catchers, record);
}

}  // namespace foveray::render
