#include "render/deform.h"

#include <algorithm>

#include "render/scene/scene.h"
#include "shaders/shared/deform.h"

namespace foveray::render {
namespace {

std::vector<shared::SkinVertex> pack_skin(const scene::Primitive& p) {
    std::vector<shared::SkinVertex> skin(p.joints.size());
    for (std::size_t i = 0; i < skin.size(); ++i) {
        const glm::u16vec4 j = p.joints[i];
        skin[i] = {{j.x | std::uint32_t{j.y} << 16, j.z | std::uint32_t{j.w} << 16}, p.weights[i]};
    }
    return skin;
}

/// Displacements as deform.comp reads them; parts that do not move, or that the primitive does not have, are
/// zero.
std::vector<vec3> pack_targets(const scene::Primitive& p) {
    const std::size_t count = p.positions.size();
    std::vector<vec3> packed(p.morph_targets.size() * 3 * count, vec3(0.0f));
    auto out = packed.begin();
    for (const scene::MorphTarget& target : p.morph_targets) {
        std::copy(target.positions.begin(), target.positions.end(), out);
        std::copy(target.normals.begin(), target.normals.end(), out + static_cast<std::ptrdiff_t>(count));
        if (!p.tangents.empty()) {
            std::copy(target.tangents.begin(), target.tangents.end(),
                      out + static_cast<std::ptrdiff_t>(2 * count));
        }
        out += static_cast<std::ptrdiff_t>(3 * count);
    }
    return packed;
}

}  // namespace

DeformStage::DeformStage(const gpu::Device& device, const gpu::TextureTable& textures,
                         gpu::Uploader& uploader, const scene::Scene& scene,
                         std::span<const GpuMesh* const> rest, std::uint32_t slots)
    : pipeline_(device, "render/deform.comp", textures, sizeof(shared::DeformPush)) {
    for (scene::DeformationId id = 0; id < scene.deformations.size(); ++id) {
        const scene::Deformation& deformation = scene.deformations[id];
        const scene::Mesh& source = scene.meshes[deformation.mesh];
        const std::string name = "deformation " + std::to_string(id) + " " + source.name;
        Mesh mesh;
        mesh.rest = rest[id];
        std::vector<vec3> positions;
        std::vector<shared::VertexAttributes> attributes;
        for (std::size_t i = 0; i < source.primitives.size(); ++i) {
            const scene::Primitive& p = source.primitives[i];
            Inputs inputs;
            const bool skinned = deformation.skin && !p.joints.empty();
            if (skinned) inputs.skin = uploader.buffer(name + " skin", gpu::range_bytes(pack_skin(p)));
            inputs.target_count = static_cast<std::uint32_t>(p.morph_targets.size());
            inputs.targets = uploader.buffer(name + " morph targets", gpu::range_bytes(pack_targets(p)));
            mesh.inputs.push_back(std::move(inputs));

            GpuGeometry geometry = mesh.rest->geometries()[i];
            geometry.positions = positions.size() * sizeof(vec3);
            geometry.attributes = attributes.size() * sizeof(shared::VertexAttributes);
            mesh.geometries.push_back(geometry);
            positions.insert(positions.end(), p.positions.begin(), p.positions.end());
            const auto packed = pack_attributes(p);
            attributes.insert(attributes.end(), packed.begin(), packed.end());
        }
        mesh.positions = uploader.buffer(name + " positions", gpu::range_bytes(positions), gpu::build_input);
        mesh.previous_positions = uploader.buffer(name + " previous positions", gpu::range_bytes(positions));
        mesh.attributes = uploader.buffer(name + " attributes", gpu::range_bytes(attributes));
        for (GpuGeometry& geometry : mesh.geometries) {
            geometry.previous_positions = geometry.positions + mesh.previous_positions.address();
            geometry.positions += mesh.positions.address();
            geometry.attributes += mesh.attributes.address();
        }
        const std::size_t joint_count = deformation.skin ? scene.skins[*deformation.skin].joints.size() : 0;
        mesh.joints = FrameBuffer(device, name + " joints", joint_count * sizeof(mat4), slots);
        std::size_t weight_count = 0;
        for (const Inputs& inputs : mesh.inputs)
            weight_count = std::max<std::size_t>(weight_count, inputs.target_count);
        mesh.weights = FrameBuffer(device, name + " morph weights", weight_count * sizeof(float), slots);
        meshes_.push_back(std::move(mesh));
    }
}

void DeformStage::record(const gpu::Commands& cmd, std::uint32_t slot,
                         std::span<const scene::DeformationState> states) {
    using gpu::Access;
    if (meshes_.empty()) return;
    for (const Access use : {Access::RayTracingRead, Access::AccelerationBuildInput, Access::ComputeWrite}) {
        cmd.barrier(use, Access::ComputeWrite);
        cmd.barrier(use, Access::TransferWrite);
    }
    cmd.barrier(Access::ComputeWrite, Access::TransferRead);
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        Mesh& mesh = meshes_[i];
        const scene::DeformationState& state = states[i];
        const bool was_changed = mesh.changed;
        mesh.changed =
            !mesh.started || state.joints != mesh.last_joints || state.morph_weights != mesh.last_weights;
        if (mesh.started && (mesh.changed || was_changed)) copy_to_previous(cmd, mesh);
        if (!mesh.changed) continue;
        mesh.last_joints = state.joints;
        mesh.last_weights = state.morph_weights;
        mesh.joints.record(cmd, slot, gpu::range_bytes(state.joints));
        mesh.weights.record(cmd, slot, gpu::range_bytes(state.morph_weights));
    }
    cmd.barrier(Access::TransferRead, Access::ComputeWrite);
    cmd.barrier(Access::TransferWrite, Access::ComputeRead);
    for (const Mesh& mesh : meshes_) {
        if (mesh.changed) dispatch(cmd, mesh);
    }
    cmd.barrier(Access::ComputeWrite, Access::TransferRead);
    for (Mesh& mesh : meshes_) {
        if (!mesh.started) copy_to_previous(cmd, mesh);
        mesh.started = true;
    }
    cmd.barrier(Access::ComputeWrite, Access::AccelerationBuildInput);
    cmd.barrier(Access::ComputeWrite, Access::RayTracingRead);
    cmd.barrier(Access::TransferWrite, Access::RayTracingRead);
}

void DeformStage::copy_to_previous(const gpu::Commands& cmd, const Mesh& mesh) {
    cmd->copyBuffer(mesh.positions.vk(), mesh.previous_positions.vk(),
                    vk::BufferCopy(0, 0, mesh.positions.size()));
}

void DeformStage::dispatch(const gpu::Commands& cmd, const Mesh& mesh) const {
    for (std::size_t i = 0; i < mesh.geometries.size(); ++i) {
        const GpuGeometry& from = mesh.rest->geometries()[i];
        const GpuGeometry& to = mesh.geometries[i];
        const Inputs& inputs = mesh.inputs[i];
        const shared::DeformPush push{
            from.positions,
            from.attributes,
            inputs.skin ? inputs.skin.address() : 0,
            inputs.targets.address(),
            mesh.joints.address(),
            mesh.weights.address(),
            to.positions,
            to.attributes,
            to.vertex_count,
            std::min(inputs.target_count, static_cast<std::uint32_t>(mesh.last_weights.size()))};
        pipeline_.dispatch(cmd, push, {to.vertex_count, 1, 1}, {64, 1, 1});
    }
}

}  // namespace foveray::render
