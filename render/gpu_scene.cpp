#include "render/gpu_scene.h"

#include "render/gpu_lights.h"
#include "render/scene/singular.h"
#include "shaders/shared/ray_types.h"

namespace foveray::render {
namespace {

std::size_t light_count(const scene::Scene& scene) {
    std::size_t count = 0;
    for (const scene::Node& node : scene.nodes) count += node.light.has_value() + node.area_light.has_value();
    return count;
}

/// Meshes that are drawn as they are, not deformed.
std::vector<bool> rigid_meshes(const scene::Scene& scene) {
    std::vector<bool> rigid(scene.meshes.size());
    for (const scene::Instance& instance : scene.instances) {
        if (!instance.deformation) rigid[instance.mesh] = true;
    }
    return rigid;
}

std::vector<bool> used_meshes(const scene::Scene& scene) {
    std::vector<bool> used(scene.meshes.size());
    for (const scene::Instance& instance : scene.instances) used[instance.mesh] = true;
    for (const scene::RealSurface& surface : scene.real_surfaces) used[surface.mesh] = true;
    return used;
}

/// A scale of 0 hides what has it; rays cannot be taken into its space, and Vulkan forbids such instances.
void hide_if_singular(GpuInstance& instance) {
    if (scene::is_invertible(instance.world_from_object)) return;
    instance.mask = 0;
    instance.world_from_object = mat4(1.0f);
}

}  // namespace

GpuScene::GpuScene(const gpu::Device& device, gpu::TextureTable& textures, const scene::Scene& scene,
                   std::uint32_t slots, vk::DeviceSize portion, MeshStore* store)
    : scene_(scene),
      uploader_(device, portion),
      textures_(device, textures, uploader_, scene),
      environment_(device, textures, scene.environment) {
    packed_materials_ = textures_.materials();
    materials_ = FrameBuffer(device, "materials", packed_materials_.size() * sizeof(shared::Material), slots);
    MeshStore own;
    upload_structures(device, textures, uploader_, slots, store ? *store : own);
    uploader_.flush();
    instances_.resize(structure_of_instance_.size());
    previous_.resize(structure_of_instance_.size());
    instance_data_ = FrameBuffer(device, "instances", previous_.size() * sizeof(shared::InstanceData), slots);
    lights_ = FrameBuffer(device, "lights", light_count(scene) * sizeof(shared::Light), slots);
    scene_data_ = FrameBuffer(device, "scene data", sizeof(shared::SceneData), slots);
}

std::vector<GpuGeometry> GpuScene::geometries_of(scene::MeshId id, std::uint32_t level) const {
    const GpuMesh& mesh = meshes_[id]->mesh();
    std::vector<GpuGeometry> geometries = level == 0 ? mesh.geometries() : mesh.level(level - 1);
    for (std::size_t i = 0; i < geometries.size(); ++i)
        geometries[i].material = scene_.meshes[id].primitives[i].material;
    return geometries;
}

void GpuScene::upload_structures(const gpu::Device& device, gpu::TextureTable& textures,
                                 gpu::Uploader& uploader, std::uint32_t slots, MeshStore& store) {
    const std::vector<bool> used = used_meshes(scene_), rigid = rigid_meshes(scene_);
    meshes_.resize(scene_.meshes.size());
    for (scene::MeshId id = 0; id < meshes_.size(); ++id) {
        if (!used[id]) continue;
        const scene::Mesh& mesh = scene_.meshes[id];
        meshes_[id] = store.get(uploader, "mesh " + std::to_string(id) + " " + mesh.name, mesh, rigid[id]);
    }
    const auto add_structure = [&](std::string name, GpuStructure::Kind kind, std::uint32_t source,
                                   std::vector<GpuGeometry> geometries) -> GpuStructure& {
        return structures_.emplace_back(
            GpuStructure{std::move(name), kind, source, std::move(geometries), {}, nullptr, 0});
    };
    const auto last = [&] { return static_cast<std::uint32_t>(structures_.size() - 1); };

    const auto add_mesh = [&](scene::MeshId id) {
        const std::vector<float>& errors = meshes_[id]->level_errors();
        const std::string name = "mesh " + std::to_string(id);
        GpuStructure& finest = add_structure(name, GpuStructure::Kind::Mesh, id, geometries_of(id, 0));
        finest.level_errors = errors;
        finest.shared = meshes_[id];
        const std::uint32_t structure = last();
        for (std::uint32_t level = 1; level < errors.size(); ++level) {
            GpuStructure& coarser = add_structure(name + " level " + std::to_string(level),
                                                  GpuStructure::Kind::Mesh, id, geometries_of(id, level));
            coarser.shared = meshes_[id];
            coarser.level = level;
        }
        return structure;
    };
    constexpr std::uint32_t none = ~0u;
    std::vector<std::uint32_t> structure_of_mesh(meshes_.size(), none);
    for (const scene::Instance& instance : scene_.instances) {
        std::uint32_t& structure = structure_of_mesh[instance.mesh];
        if (!instance.deformation && structure == none) structure = add_mesh(instance.mesh);
    }
    first_deformed_ = static_cast<std::uint32_t>(structures_.size());
    std::vector<const GpuMesh*> rest;
    for (const scene::Deformation& deformation : scene_.deformations)
        rest.push_back(&meshes_[deformation.mesh]->mesh());
    deform_ = std::make_unique<DeformStage>(device, textures, uploader, scene_, rest, slots);
    for (scene::DeformationId id = 0; id < scene_.deformations.size(); ++id) {
        add_structure("deformation " + std::to_string(id), GpuStructure::Kind::DeformedMesh, id,
                      deform_->geometries(id));
    }
    for (const scene::Instance& instance : scene_.instances) {
        structure_of_instance_.push_back(instance.deformation ? first_deformed_ + *instance.deformation
                                                              : structure_of_mesh[instance.mesh]);
    }
    first_shape_ = static_cast<std::uint32_t>(structures_.size());
    shapes_ = std::make_unique<GpuShapes>(uploader, scene_);
    for (scene::ShapeId id = 0; id < scene_.shapes.size(); ++id) {
        add_structure("shape " + std::to_string(id) + " " + scene_.shapes[id].name, GpuStructure::Kind::Shape,
                      id, {});
    }
    for (const scene::ShapeInstance& instance : scene_.shape_instances) {
        structure_of_instance_.push_back(first_shape_ + instance.shape);
    }
    for (std::uint32_t id = 0; id < scene_.real_surfaces.size(); ++id) {
        const scene::RealSurface& surface = scene_.real_surfaces[id];
        add_structure("real surface " + std::to_string(id) + " " + surface.name,
                      GpuStructure::Kind::RealSurface, id, geometries_of(surface.mesh, 0))
            .shared = meshes_[surface.mesh];
        structure_of_instance_.push_back(last());
    }
    structure_changed_.resize(structures_.size());
}

void GpuScene::update_instances(const scene::SceneChanges& changes, const Pose& world_from_stage) {
    const std::size_t virtual_count = scene_.instances.size();
    for (std::size_t i = 0; i < virtual_count; ++i) {
        const scene::InstanceState& state = changes.instances[i];
        const scene::Instance& source = scene_.instances[i];
        GpuInstance& instance = instances_[i];
        instance.structure = structure_of_instance_[i];
        instance.world_from_object = state.world_from_object;
        const bool moves = state.moved || structure_changed_[instance.structure];
        instance.mask = shared::MASK_VIRTUAL | (moves && started_ ? shared::MASK_MOVING : 0u);
        if (!state.present) instance.mask = 0;
        if (source.deformation) {
            const auto& joints = changes.deformations[*source.deformation].joints;
            instance.mirrored_vertices = !joints.empty() && glm::determinant(mat3(joints.front())) < 0.0f;
        }
        hide_if_singular(instance);
        previous_[i] = {glm::mat4x3(state.previous_world_from_object), source.node};
    }
    const std::size_t first_shape = virtual_count;
    for (std::size_t i = 0; i < scene_.shape_instances.size(); ++i) {
        const scene::InstanceState& state = changes.shape_instances[i];
        GpuInstance& instance = instances_[first_shape + i];
        instance.structure = structure_of_instance_[first_shape + i];
        instance.world_from_object = state.world_from_object;
        const bool moves = state.moved || structure_changed_[instance.structure];
        instance.mask = shared::MASK_VIRTUAL | (moves && started_ ? shared::MASK_MOVING : 0u);
        if (!state.present) instance.mask = 0;
        hide_if_singular(instance);
        previous_[first_shape + i] = {glm::mat4x3(state.previous_world_from_object),
                                      scene_.shape_instances[i].node};
    }
    const std::size_t first_real = first_shape + scene_.shape_instances.size();
    const mat4 world_from_stage_matrix = to_matrix(world_from_stage);
    for (std::size_t i = 0; i < scene_.real_surfaces.size(); ++i) {
        GpuInstance& instance = instances_[first_real + i];
        const mat4 before = instance.world_from_object;
        instance.structure = structure_of_instance_[first_real + i];
        instance.world_from_object = world_from_stage_matrix * scene_.real_surfaces[i].stage_from_object;
        instance.mask = shared::MASK_REAL;
        previous_[first_real + i] = {glm::mat4x3(started_ ? before : instance.world_from_object),
                                     static_cast<std::uint32_t>(i)};
    }
}

void GpuScene::record_materials(const gpu::Commands& cmd, std::uint32_t slot,
                                const scene::SceneChanges& changes) {
    bool changed = !started_;
    for (const scene::MaterialState& state : changes.materials) {
        if (!state.changed && started_) continue;
        pack_values(state.values, packed_materials_[state.material]);
        changed = true;
    }
    if (changed) materials_.record(cmd, slot, gpu::range_bytes(packed_materials_));
}

GpuSceneFrame GpuScene::record(const gpu::Commands& cmd, std::uint32_t slot,
                               const scene::SceneChanges& changes, const Pose& world_from_stage) {
    using gpu::Access;
    const auto stage = cmd.stage("scene");
    deform_->record(cmd, slot, changes.deformations);
    for (scene::DeformationId id = 0; id < scene_.deformations.size(); ++id) {
        structure_changed_[first_deformed_ + id] = deform_->changed(id);
    }
    shapes_->record(cmd, changes.shapes);
    for (scene::ShapeId id = 0; id < scene_.shapes.size(); ++id) {
        structure_changed_[first_shape_ + id] = changes.shapes[id].changed;
    }
    update_instances(changes, world_from_stage);

    const std::vector<shared::Light> lights = pack_lights(changes);
    shared::SceneData data{};
    data.lights = lights_.address();
    data.materials = materials_.address();
    data.light_count = static_cast<std::uint32_t>(lights.size());
    data.catcher_count = static_cast<std::uint32_t>(scene_.real_surfaces.size());
    data.environment = environment_.shared();

    cmd.barrier(Access::RayTracingRead, Access::TransferWrite);
    cmd.barrier(Access::ComputeRead, Access::TransferWrite);
    record_materials(cmd, slot, changes);
    instance_data_.record(cmd, slot, gpu::range_bytes(previous_));
    lights_.record(cmd, slot, gpu::range_bytes(lights));
    scene_data_.record(cmd, slot, gpu::bytes_of(data));
    cmd.barrier(Access::TransferWrite, Access::RayTracingRead);
    cmd.barrier(Access::TransferWrite, Access::ComputeRead);
    started_ = true;
    return {scene_data_.address(), data.light_count, instances_,
            structure_changed_,    changes.shapes,   static_cast<float>(to_seconds(changes.time))};
}

}  // namespace foveray::render
