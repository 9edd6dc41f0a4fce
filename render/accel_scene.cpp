#include "render/accel_scene.h"

#include <algorithm>

namespace foveray::render {
namespace {

RayPipeline::Range table_range(const GpuScene& scene, const GpuShape& shape, const RayPipeline& pipeline) {
    RayPipeline::Range range;
    for (const GpuGeometry& g : shape.geometries) {
        if (shape.kind == GpuShape::Kind::RealSurface) {
            const scene::RealSurface& surface = scene.scene().real_surfaces[shape.source];
            shared::CatcherRecord record{};
            record.positions = g.positions;
            record.indices = g.indices;
            record.instances = scene.instances();
            record.albedo = surface.albedo;
            record.roughness = surface.roughness;
            record.reflectance = surface.reflectance;
            record.surface = shape.source;
            range.push_back(pipeline.catcher(record));
        } else {
            shared::TriangleRecord record{};
            record.positions = g.positions;
            record.previous_positions = g.previous_positions;
            record.indices = g.indices;
            record.attributes = g.attributes;
            record.materials = scene.materials();
            record.instances = scene.instances();
            record.material = g.material;
            range.push_back(pipeline.triangles(record));
        }
    }
    return range;
}

/// What a geometry's material means to rays.
struct Sides {
    bool double_sided = true;
    bool solid = true;  // no any-hit shader for its alpha
};

Sides sides_of(const GpuScene& scene, const GpuShape& shape, const GpuGeometry& geometry) {
    if (shape.kind == GpuShape::Kind::RealSurface) return {};
    const scene::Material& material = scene.scene().materials[geometry.material];
    return {material.double_sided, material.alpha_mode == scene::AlphaMode::Opaque};
}

}  // namespace

AccelScene::AccelScene(const gpu::Device& device, const GpuScene& scene, RayPipeline& pipeline,
                       std::uint32_t slots)
    : top_level_(device, "scene", slots) {
    std::vector<gpu::BottomLevelInfo> infos;
    std::vector<RayPipeline::Range> ranges;
    for (const GpuShape& source : scene.shapes()) {
        Shape shape;
        for (const GpuGeometry& g : source.geometries) {
            shape.any_double_sided |= sides_of(scene, source, g).double_sided;
        }
        for (const GpuGeometry& g : source.geometries) {
            const Sides sides = sides_of(scene, source, g);
            // The ray's cull flag spares an instance with double-sided geometry; its single-sided geometries
            // are culled by the any-hit shader.
            const bool opaque = sides.solid && (sides.double_sided || !shape.any_double_sided);
            shape.geometries.push_back(gpu::TriangleGeometry{.positions = g.positions,
                                                             .position_count = g.vertex_count,
                                                             .indices = g.indices,
                                                             .triangle_count = g.triangle_count,
                                                             .opaque = opaque});
        }
        infos.push_back({source.name, shape.geometries, source.kind == GpuShape::Kind::DeformedMesh});
        ranges.push_back(table_range(scene, source, pipeline));
        shapes_.push_back(std::move(shape));
    }
    const std::vector<std::uint32_t> offsets = pipeline.tracer().set_table(ranges);
    std::vector<gpu::BottomLevel> structures = gpu::build_bottom_levels(device, infos);
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
        shapes_[i].structure = std::move(structures[i]);
        shapes_[i].record_offset = offsets[i];
    }
}

void AccelScene::record(const gpu::Commands& cmd, std::uint32_t slot, const GpuSceneFrame& frame,
                        RayPipeline& pipeline) {
    const auto stage = cmd.stage("acceleration");
    std::vector<gpu::BottomLevelUpdate> updates;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
        if (!frame.shape_changed[i]) continue;
        // The first time too: what was built at the start were the undeformed vertices.
        const bool refit = shapes_[i].updates++ % rebuild_period != 0;
        updates.push_back({&shapes_[i].structure, shapes_[i].geometries, refit});
    }
    if (!updates.empty()) gpu::update_bottom_levels(cmd, updates);

    instances_.clear();
    for (std::size_t i = 0; i < frame.instances.size(); ++i) {
        using Flag = vk::GeometryInstanceFlagBitsKHR;
        const GpuInstance& source = frame.instances[i];
        const Shape& shape = shapes_[source.shape];
        gpu::TopLevelInstance instance;
        instance.world_from_object = glm::mat4x3(source.world_from_object);
        instance.custom_index = static_cast<std::uint32_t>(i);
        instance.record_offset = shape.record_offset;
        instance.mask = static_cast<std::uint8_t>(source.mask);
        // Front is where the corners go counter-clockwise in object space, which no instance transform
        // changes.
        if (source.mirrored_vertices) instance.flags |= Flag::eTriangleFlipFacing;
        if (shape.any_double_sided) instance.flags |= Flag::eTriangleFacingCullDisable;
        instance.bottom_level = shape.structure.address();
        instances_.push_back(instance);
    }
    top_level_.build(cmd, slot, instances_);
    pipeline.tracer().prepare(cmd, slot, top_level_);
}

}  // namespace foveray::render
