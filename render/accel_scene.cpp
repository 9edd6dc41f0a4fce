#include "render/accel_scene.h"

#include <algorithm>

namespace foveray::render {
namespace {

RayPipeline::Geometry triangle_record(const GpuScene& scene, const GpuGeometry& g,
                                      const RayPipeline& pipeline) {
    shared::TriangleRecord record{};
    record.positions = g.positions;
    record.previous_positions = g.previous_positions;
    record.indices = g.indices;
    record.attributes = g.attributes;
    record.materials = scene.materials();
    record.instances = scene.instances();
    record.material = g.material;
    return pipeline.triangles(record);
}

RayPipeline::Geometry catcher_record(const GpuScene& scene, std::uint32_t id, const GpuGeometry& g,
                                     const RayPipeline& pipeline) {
    const scene::RealSurface& surface = scene.scene().real_surfaces[id];
    shared::CatcherRecord record{};
    record.positions = g.positions;
    record.indices = g.indices;
    record.instances = scene.instances();
    record.albedo = surface.albedo;
    record.roughness = surface.roughness;
    record.reflectance = surface.reflectance;
    record.surface = id;
    return pipeline.catcher(record);
}

RayPipeline::Geometry shape_record(const GpuScene& scene, scene::ShapeId id, std::span<const float> values,
                                   float seconds, const RayPipeline& pipeline) {
    const scene::Shape& shape = scene.scene().shapes[id];
    shared::ShapeHeader header{};
    header.materials = scene.materials();
    header.instances = scene.instances();
    header.material = shape.material;
    header.shape = id;
    header.flags = scene.scene().materials[shape.material].double_sided ? 0 : shared::SHAPE_SINGLE_SIDED;
    return pipeline.shapes().geometry(shape, values, header, scene.shapes(), seconds);
}

RayPipeline::Range table_range(const GpuScene& scene, const GpuStructure& structure,
                               const RayPipeline& pipeline) {
    if (structure.kind == GpuStructure::Kind::Shape) {
        return {shape_record(scene, structure.source, scene.scene().shapes[structure.source].values, 0.0f,
                             pipeline)};
    }
    RayPipeline::Range range;
    for (const GpuGeometry& g : structure.geometries) {
        range.push_back(structure.kind == GpuStructure::Kind::RealSurface
                            ? catcher_record(scene, structure.source, g, pipeline)
                            : triangle_record(scene, g, pipeline));
    }
    return range;
}

bool lets_no_light_through(const scene::Material& material) {
    return material.alpha_mode == scene::AlphaMode::Opaque && material.transmission == 0.0f;
}

/// What a geometry's material means to rays.
struct Sides {
    bool double_sided = true;
    bool solid = true;  // no any-hit shader for its alpha
};

Sides sides_of(const GpuScene& scene, const GpuStructure& structure, const GpuGeometry& geometry) {
    if (structure.kind == GpuStructure::Kind::RealSurface) return {};
    const scene::Material& material = scene.scene().materials[geometry.material];
    return {material.double_sided, lets_no_light_through(material)};
}

gpu::BoxGeometry box_of(const GpuScene& scene, scene::ShapeId id) {
    const scene::Shape& shape = scene.scene().shapes[id];
    const auto is_opaque = [&](scene::MaterialId material) {
        return lets_no_light_through(scene.scene().materials[material]);
    };
    bool opaque = is_opaque(shape.material) && !shape.voxels;  // coarse voxels cover their place in part
    for (const scene::CsgLeaf& leaf : shape.solid.leaves) {
        opaque &= is_opaque(leaf.material.value_or(shape.material));
    }
    return {.boxes = scene.shapes().box(id), .box_count = 1, .opaque = opaque};
}

}  // namespace

AccelScene::AccelScene(const gpu::Device& device, const GpuScene& scene, RayPipeline& pipeline,
                       std::uint32_t slots)
    : scene_(scene), top_level_(device, "scene", slots) {
    std::vector<gpu::BottomLevelInfo> infos;
    for (const GpuStructure& source : scene.structures()) {
        Structure structure;
        for (const GpuGeometry& g : source.geometries) {
            structure.any_double_sided |= sides_of(scene, source, g).double_sided;
        }
        for (const GpuGeometry& g : source.geometries) {
            const Sides sides = sides_of(scene, source, g);
            // The ray's cull flag spares an instance with double-sided geometry; its single-sided geometries
            // are culled by the any-hit shader.
            const bool opaque = sides.solid && (sides.double_sided || !structure.any_double_sided);
            structure.geometries.push_back(gpu::TriangleGeometry{.positions = g.positions,
                                                                 .position_count = g.vertex_count,
                                                                 .indices = g.indices,
                                                                 .triangle_count = g.triangle_count,
                                                                 .opaque = opaque});
        }
        const bool is_shape = source.kind == GpuStructure::Kind::Shape;
        if (is_shape) structure.geometries.push_back(box_of(scene, source.source));
        const bool deforms = source.kind == GpuStructure::Kind::DeformedMesh ||
                             (is_shape && scene.scene().shapes[source.source].animated);
        infos.push_back({source.name, structure.geometries, deforms});
        table_.push_back(table_range(scene, source, pipeline));
        structures_.push_back(std::move(structure));
    }
    const std::vector<std::uint32_t> offsets = pipeline.tracer().set_table(table_);
    std::vector<gpu::BottomLevel> levels = gpu::build_bottom_levels(device, infos);
    for (std::size_t i = 0; i < structures_.size(); ++i) {
        structures_[i].level = std::move(levels[i]);
        structures_[i].record_offset = offsets[i];
    }
}

void AccelScene::fill_table(RayPipeline& pipeline) const { pipeline.tracer().set_table(table_); }

void AccelScene::record(const gpu::Commands& cmd, std::uint32_t slot, const GpuSceneFrame& frame,
                        RayPipeline& pipeline, const MeshDetail& detail) {
    const auto stage = cmd.stage("acceleration");
    update_structures(cmd, frame, pipeline);

    instances_.clear();
    triangle_count_ = 0;
    for (std::size_t i = 0; i < frame.instances.size(); ++i) {
        using Flag = vk::GeometryInstanceFlagBitsKHR;
        const GpuInstance& source = frame.instances[i];
        const std::uint32_t index = structure_for(source, detail);
        const Structure& structure = structures_[index];
        for (const GpuGeometry& g : scene_.structures()[index].geometries)
            triangle_count_ += g.triangle_count;
        gpu::TopLevelInstance instance;
        instance.world_from_object = glm::mat4x3(source.world_from_object);
        instance.custom_index = static_cast<std::uint32_t>(i);
        instance.record_offset = structure.record_offset;
        instance.mask = static_cast<std::uint8_t>(source.mask);
        // Front is where the corners go counter-clockwise in object space, which no instance transform
        // changes.
        if (source.mirrored_vertices) instance.flags |= Flag::eTriangleFlipFacing;
        if (structure.any_double_sided) instance.flags |= Flag::eTriangleFacingCullDisable;
        instance.bottom_level = structure.level.address();
        instances_.push_back(instance);
    }
    top_level_.build(cmd, slot, instances_);
    pipeline.tracer().prepare(cmd, slot, top_level_);
}

std::uint32_t AccelScene::structure_for(const GpuInstance& instance, const MeshDetail& detail) const {
    const GpuStructure& structure = scene_.structures()[instance.structure];
    if (structure.level_errors.empty()) return instance.structure;
    const scene::Aabb& bounds = scene_.scene().meshes[structure.source].bounds;
    return instance.structure + detail.level(structure.level_errors, bounds, instance.world_from_object);
}

void AccelScene::update_structures(const gpu::Commands& cmd, const GpuSceneFrame& frame,
                                   RayPipeline& pipeline) {
    std::vector<gpu::BottomLevelUpdate> updates;
    bool records_changed = false;
    for (std::size_t i = 0; i < structures_.size(); ++i) {
        if (frame.structure_changed[i]) {
            // The first time too: what was built at the start were the undeformed vertices.
            const bool refit = structures_[i].updates++ % rebuild_period != 0;
            updates.push_back({&structures_[i].level, structures_[i].geometries, refit});
        }
        const GpuStructure& source = scene_.structures()[i];
        if (source.kind != GpuStructure::Kind::Shape) continue;
        const scene::Shape& shape = scene_.scene().shapes[source.source];
        if (!frame.structure_changed[i] && !pipeline.shapes().uses_time(shape)) continue;
        table_[i] = {
            shape_record(scene_, source.source, frame.shapes[source.source].values, frame.seconds, pipeline)};
        records_changed = true;
    }
    if (!updates.empty()) gpu::update_bottom_levels(cmd, updates);
    if (records_changed) pipeline.tracer().set_table(table_);
}

}  // namespace foveray::render
