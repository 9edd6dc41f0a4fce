#include "render/scene/scene_builder.h"

#include <algorithm>
#include <cassert>

#include "base/log.h"
#include "render/scene/animator.h"
#include "render/scene/complete_mesh.h"
#include "render/scene/deform.h"
#include "render/scene/singular.h"

namespace foveray::scene {
namespace {

template <typename T>
std::uint32_t append(std::vector<T>& values, T value) {
    values.push_back(std::move(value));
    return static_cast<std::uint32_t>(values.size() - 1);
}

std::size_t morph_target_count(const Mesh& mesh) {
    std::size_t count = 0;
    for (const Primitive& p : mesh.primitives) count = std::max(count, p.morph_targets.size());
    return count;
}

std::vector<DeformedVertices> deformed_at_start(const Scene& scene, const SceneChanges& start,
                                                const Instance& instance) {
    std::vector<DeformedVertices> out;
    for (const Primitive& p : scene.meshes[instance.mesh].primitives) {
        if (instance.deformation) {
            const DeformationState& s = start.deformations[*instance.deformation];
            out.push_back(deform(p, s.joints, s.morph_weights));
        } else {
            out.push_back({p.positions, p.normals, p.tangents});
        }
    }
    return out;
}

/// Some channel moves a node that the deformation depends on.
bool is_animated(const Scene& scene, const Deformation& deformation) {
    std::vector<bool> moves(scene.nodes.size(), false);
    bool own_weights = false;
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) {
            if (is_of_material(channel.property)) continue;
            if (channel.property == AnimatedProperty::Weights) {
                own_weights |= channel.node == deformation.node;
            } else {
                moves[channel.node] = true;
            }
        }
    }
    for (NodeId id = 0; id < scene.nodes.size(); ++id) {
        if (scene.nodes[id].parent && moves[*scene.nodes[id].parent]) moves[id] = true;
    }
    const auto joint_moves = [&](NodeId joint) { return moves[joint]; };
    return own_weights ||
           (deformation.skin && std::ranges::any_of(scene.skins[*deformation.skin].joints, joint_moves));
}

/// Makes the material fit for all values that it will have: structures are built for see-through ones or not.
void prepare_for(const AnimationChannel& channel, Material& material) {
    if (channel.property == AnimatedProperty::Alpha && material.alpha_mode == AlphaMode::Opaque) {
        material.alpha_mode = AlphaMode::Blend;
    }
    material.becomes_transmissive |= channel.property == AnimatedProperty::Transmission;
}

}  // namespace

SceneBuilder::SceneBuilder(std::vector<std::filesystem::path>* files) : files_(files) {
    scene_.materials.emplace_back().name = "default";
    scene_.environment = default_sky();
}

void SceneBuilder::note_file(const std::filesystem::path& file) {
    if (files_ && std::ranges::find(*files_, file) == files_->end()) files_->push_back(file);
}

ImageId SceneBuilder::add(TextureImage image) {
    assert(image.pixels.channels == 4 && !image.pixels.empty());
    return append(scene_.images, std::move(image));
}

TextureId SceneBuilder::add(Texture texture) {
    assert(texture.image < scene_.images.size());
    return append(scene_.textures, texture);
}

MaterialId SceneBuilder::add(Material material) { return append(scene_.materials, std::move(material)); }

MeshId SceneBuilder::add(Mesh mesh) {
    mesh.bounds = {};
    for (Primitive& p : mesh.primitives) {
        assert(p.material < scene_.materials.size() && !p.indices.empty() && p.indices.size() % 3 == 0);
        const Material& material = scene_.materials[p.material];
        if (p.normals.empty()) make_flat_normals(p);
        if (p.tangents.empty() && material.normal_texture) make_tangents(p, material.normal_texture);
        for (const vec3 position : p.positions) mesh.bounds.add(position);
    }
    mesh.morph_weights.resize(morph_target_count(mesh), 0.0f);
    return append(scene_.meshes, std::move(mesh));
}

ShapeId SceneBuilder::add(Shape shape) {
    assert(shape.material < scene_.materials.size());
    return append(scene_.shapes, std::move(shape));
}

UserShapeId SceneBuilder::add(UserShape shape) { return append(scene_.user_shapes, std::move(shape)); }

NodeId SceneBuilder::add(Node node) {
    assert(!node.parent || *node.parent < scene_.nodes.size());
    assert(!node.mesh || *node.mesh < scene_.meshes.size());
    assert(!node.shape || (*node.shape < scene_.shapes.size() && !node.mesh));
    assert(!node.light || *node.light < scene_.lights.size());
    assert(!node.area_light || *node.area_light < scene_.area_lights.size());
    assert(!node.camera || *node.camera < scene_.cameras.size());
    return append(scene_.nodes, std::move(node));
}

SkinId SceneBuilder::add(Skin skin) {
    assert(skin.joints.size() == skin.inverse_bind.size());
    return append(scene_.skins, std::move(skin));
}

void SceneBuilder::add(Animation animation) {
    animation.duration = 0.0f;
    for (const AnimationChannel& channel : animation.channels) {
        assert(!channel.times.empty());
        animation.duration = std::max(animation.duration, channel.times.back());
        if (is_of_material(channel.property)) {
            prepare_for(channel, scene_.materials[channel.material]);
            continue;
        }
        assert(channel.node < scene_.nodes.size());
        if (channel.property == AnimatedProperty::ShapeValues) {
            scene_.shapes[*scene_.nodes[channel.node].shape].animated = true;
        }
    }
    scene_.animations.push_back(std::move(animation));
}

LightId SceneBuilder::add(Light light) { return append(scene_.lights, std::move(light)); }
AreaLightId SceneBuilder::add(AreaLight light) { return append(scene_.area_lights, std::move(light)); }
CameraId SceneBuilder::add(Camera camera) { return append(scene_.cameras, std::move(camera)); }

void SceneBuilder::add(RealSurface surface) {
    assert(surface.mesh < scene_.meshes.size());
    scene_.real_surfaces.push_back(std::move(surface));
}

void SceneBuilder::set_skin(NodeId node, SkinId skin) {
    assert(skin < scene_.skins.size() && scene_.nodes[node].mesh);
    scene_.nodes[node].skin = skin;
}

void SceneBuilder::set_local(NodeId node, const Transform& parent_from_node) {
    scene_.nodes[node].local = parent_from_node;
}

void SceneBuilder::set(Environment environment) {
    assert(environment.radiance.channels == 3 && !environment.radiance.empty());
    scene_.environment = std::move(environment);
}

void SceneBuilder::set_world_from_stage(const Pose& pose) { scene_.world_from_stage = pose; }

void SceneBuilder::warn(std::string text) {
    log::warn("{}", text);
    scene_.warnings.push_back(std::move(text));
}

void SceneBuilder::derive() {
    scene_.deformations.clear();
    scene_.instances.clear();
    scene_.shape_instances.clear();
    for (NodeId id = 0; id < scene_.nodes.size(); ++id) {
        const Node& node = scene_.nodes[id];
        if (node.shape) derive_shape_instances(id);
        if (!node.mesh) continue;
        std::optional<DeformationId> deformation;
        if (node.skin || !scene_.meshes[*node.mesh].morph_weights.empty()) {
            Deformation d{.node = id, .mesh = *node.mesh, .skin = node.skin, .animated = false};
            d.animated = is_animated(scene_, d);
            deformation = append(scene_.deformations, d);
        }
        Instance instance{
            .node = id, .mesh = *node.mesh, .node_from_object = mat4(1.0f), .deformation = deformation};
        if (node.mesh_instances.empty()) scene_.instances.push_back(instance);
        for (const Transform& transform : node.mesh_instances) {
            instance.node_from_object = to_matrix(transform);
            scene_.instances.push_back(instance);
        }
    }

    scene_.changes_what_is_behind =
        !scene_.real_surfaces.empty() || std::ranges::any_of(scene_.materials, [&](const Material& m) {
            return !m.solid && (m.transmission > 0.0f || m.becomes_transmissive);
        });
    scene_.bounds = {};
    SceneAnimator animator(scene_);
    const SceneChanges& start = animator.advance(0);
    for (InstanceId id = 0; id < scene_.instances.size(); ++id) {
        const Instance& instance = scene_.instances[id];
        const mat4& world = start.instances[id].world_from_object;
        for (const DeformedVertices& part : deformed_at_start(scene_, start, instance)) {
            for (const vec3 p : part.positions) scene_.bounds.add(vec3(world * vec4(p, 1.0f)));
        }
    }
    for (ShapeInstanceId id = 0; id < scene_.shape_instances.size(); ++id) {
        const Aabb& bounds = start.shapes[scene_.shape_instances[id].shape].bounds;
        scene_.bounds.add(transformed(bounds, start.shape_instances[id].world_from_object));
    }
}

void SceneBuilder::derive_shape_instances(NodeId id) {
    const Node& node = scene_.nodes[id];
    ShapeInstance instance{.node = id, .shape = *node.shape, .node_from_object = mat4(1.0f)};
    if (node.mesh_instances.empty()) scene_.shape_instances.push_back(instance);
    for (const Transform& transform : node.mesh_instances) {
        instance.node_from_object = to_matrix(transform);
        scene_.shape_instances.push_back(instance);
    }
}

Aabb SceneBuilder::bounds() {
    derive();
    return scene_.bounds;
}

Scene SceneBuilder::build() && {
    derive();
    return std::move(scene_);
}

Mesh flatten(const Scene& scene) {
    SceneAnimator animator(scene);
    const SceneChanges& start = animator.advance(0);
    Primitive all;
    for (InstanceId id = 0; id < scene.instances.size(); ++id) {
        const Instance& instance = scene.instances[id];
        const std::vector<DeformedVertices> parts = deformed_at_start(scene, start, instance);
        const mat4& world = start.instances[id].world_from_object;
        if (!is_invertible(world)) continue;
        const mat3 normal_matrix = glm::transpose(glm::inverse(mat3(world)));
        for (std::size_t part = 0; part < parts.size(); ++part) {
            const auto first = static_cast<std::uint32_t>(all.positions.size());
            for (const vec3 p : parts[part].positions) all.positions.push_back(vec3(world * vec4(p, 1.0f)));
            for (const vec3 n : parts[part].normals) all.normals.push_back(glm::normalize(normal_matrix * n));
            const std::vector<std::uint32_t>& indices = scene.meshes[instance.mesh].primitives[part].indices;
            const bool mirrored = glm::determinant(mat3(world)) < 0.0f;
            for (std::size_t i = 0; i < indices.size(); i += 3) {
                all.indices.push_back(first + indices[i]);
                all.indices.push_back(first + indices[i + (mirrored ? 2 : 1)]);
                all.indices.push_back(first + indices[i + (mirrored ? 1 : 2)]);
            }
        }
    }
    Mesh mesh{.name = "flattened", .primitives = {}, .morph_weights = {}, .bounds = {}};
    if (!all.indices.empty()) mesh.primitives.push_back(std::move(all));
    return mesh;
}

}  // namespace foveray::scene
