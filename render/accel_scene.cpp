#include "render/accel_scene.h"

#include <algorithm>
#include <utility>

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

/// What a geometry's material means to rays.
struct Sides {
    bool double_sided = true;
    bool solid = true;  // no any-hit shader for its alpha
};

Sides sides_of(const GpuScene& scene, const GpuStructure& structure, const GpuGeometry& geometry) {
    if (structure.kind == GpuStructure::Kind::RealSurface) return {};
    const scene::Material& material = scene.scene().materials[geometry.material];
    return {material.double_sided, scene::is_opaque(material)};
}

std::uint32_t triangles_of(const GpuStructure& structure) {
    std::uint32_t count = 0;
    for (const GpuGeometry& g : structure.geometries) count += g.triangle_count;
    return count;
}

gpu::BoxGeometry box_of(const GpuScene& scene, scene::ShapeId id) {
    const scene::Shape& shape = scene.scene().shapes[id];
    const auto is_opaque = [&](scene::MaterialId material) {
        return scene::is_opaque(scene.scene().materials[material]);
    };
    bool opaque = is_opaque(shape.material) && !shape.voxels;  // coarse voxels cover their place in part
    for (const scene::CsgLeaf& leaf : shape.solid.leaves) {
        opaque &= is_opaque(leaf.material.value_or(shape.material));
    }
    return {.boxes = scene.shapes().box(id), .box_count = 1, .opaque = opaque};
}

}  // namespace

AccelScene::AccelScene(const gpu::Device& device, const GpuScene& scene, const RayPipeline& pipeline,
                       std::uint32_t slots, vk::DeviceSize portion)
    : scene_(scene), top_level_(device, "scene", slots) {
    std::vector<std::uint32_t> primitives, geometries;
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
            structure.opaque.push_back(opaque);
        }
        const bool is_shape = source.kind == GpuStructure::Kind::Shape;
        if (is_shape) structure.geometries.push_back(box_of(scene, source.source));
        primitives.push_back(is_shape ? 1 : triangles_of(source));
        geometries.push_back(static_cast<std::uint32_t>(structure.geometries.size()));
        table_.push_back(table_range(scene, source, pipeline));
        structures_.push_back(std::move(structure));
    }
    const std::vector<std::uint32_t> offsets = engine::record_offsets(geometries, shared::RAY_TYPE_COUNT);
    for (std::size_t i = 0; i < structures_.size(); ++i) structures_[i].record_offset = offsets[i];
    plan_.emplace(std::move(primitives));
    stale_.resize(structures_.size());
    build(device, portion);
}

void AccelScene::build(const gpu::Device& device, vk::DeviceSize portion) {
    std::vector<gpu::BottomLevelInfo> infos;
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < structures_.size(); ++i) {
        const GpuStructure& source = scene_.structures()[i];
        Structure& structure = structures_[i];
        if (source.shared) structure.level = source.shared->built(source.level, structure.opaque);
        if (structure.level) continue;
        const bool deforms =
            source.kind == GpuStructure::Kind::DeformedMesh ||
            (source.kind == GpuStructure::Kind::Shape && scene_.scene().shapes[source.source].animated);
        infos.push_back({source.name, structure.geometries, deforms});
        missing.push_back(i);
    }
    std::vector<gpu::BottomLevel> levels = gpu::build_bottom_levels(device, infos, portion);
    for (std::size_t k = 0; k < missing.size(); ++k) {
        const GpuStructure& source = scene_.structures()[missing[k]];
        Structure& structure = structures_[missing[k]];
        structure.level = std::make_shared<gpu::BottomLevel>(std::move(levels[k]));
        if (source.shared) source.shared->keep(source.level, structure.opaque, structure.level);
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
        if (source.mask == 0) continue;
        const std::uint32_t index = structure_for(source, detail);
        const Structure& structure = structures_[index];
        triangle_count_ += triangles_of(scene_.structures()[index]);
        gpu::TopLevelInstance instance;
        instance.world_from_object = glm::mat4x3(source.world_from_object);
        instance.custom_index = static_cast<std::uint32_t>(i);
        instance.record_offset = structure.record_offset;
        instance.mask = static_cast<std::uint8_t>(source.mask);
        // Front is where the corners go counter-clockwise in object space, which no instance transform
        // changes.
        if (source.mirrored_vertices) instance.flags |= Flag::eTriangleFlipFacing;
        if (structure.any_double_sided) instance.flags |= Flag::eTriangleFacingCullDisable;
        instance.bottom_level = structure.level->address();
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
    std::vector<std::uint8_t> seen(structures_.size()), changed(structures_.size());
    for (const GpuInstance& instance : frame.instances) seen[instance.structure] |= instance.mask != 0;
    for (std::size_t i = 0; i < structures_.size(); ++i) {
        stale_[i] |= frame.structure_changed[i];
        if (!seen[i]) continue;
        changed[i] = std::exchange(stale_[i], std::uint8_t{0});
    }
    const std::vector<bool> rebuild = plan_->choose(changed);
    std::vector<gpu::BottomLevelUpdate> updates;
    bool records_changed = false;
    for (std::size_t i = 0; i < structures_.size(); ++i) {
        if (changed[i])
            updates.push_back({structures_[i].level.get(), structures_[i].geometries, !rebuild[i]});
        const GpuStructure& source = scene_.structures()[i];
        if (source.kind != GpuStructure::Kind::Shape) continue;
        const scene::Shape& shape = scene_.scene().shapes[source.source];
        if (!changed[i] && !(seen[i] && pipeline.shapes().uses_time(shape))) continue;
        table_[i] = {
            shape_record(scene_, source.source, frame.shapes[source.source].values, frame.seconds, pipeline)};
        records_changed = true;
    }
    if (!updates.empty()) gpu::update_bottom_levels(cmd, updates);
    if (records_changed) pipeline.tracer().set_table(table_);
}

}  // namespace foveray::render
