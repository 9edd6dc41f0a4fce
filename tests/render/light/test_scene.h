#pragma once

#include "render/scene/scene_builder.h"

namespace foveray::render {

/// Shorthand for small scenes.
struct TestScene {
    scene::SceneBuilder builder;

    /// Without light from the environment unless given.
    explicit TestScene(vec3 environment = vec3(0.0f)) {
        builder.set(scene::constant_environment(environment));
    }

    scene::NodeId add(scene::Mesh mesh, const scene::Material& material, const Pose& pose = {}) {
        for (auto& primitive : mesh.primitives) primitive.material = builder.add(material);
        scene::Node node;
        node.mesh = builder.add(std::move(mesh));
        return add(std::move(node), pose);
    }
    scene::NodeId add(const scene::Light& light, const Pose& pose) {
        scene::Node node;
        node.light = builder.add(light);
        return add(std::move(node), pose);
    }
    scene::NodeId add(const scene::AreaLight& light, const Pose& pose) {
        scene::Node node;
        node.area_light = builder.add(light);
        return add(std::move(node), pose);
    }
    void add_real(scene::Mesh mesh, vec3 albedo, float reflectance = 0.0f, float roughness = 0.0f,
                  const Pose& pose = {}) {
        scene::RealSurface surface;
        surface.name = "real";
        surface.mesh = builder.add(std::move(mesh));
        surface.albedo = albedo;
        surface.reflectance = reflectance;
        surface.roughness = roughness;
        surface.stage_from_object = to_matrix(pose);
        builder.add(std::move(surface));
    }
    scene::Scene build() { return std::move(builder).build(); }

  private:
    scene::NodeId add(scene::Node node, const Pose& pose) {
        node.local.translation = pose.position;
        node.local.rotation = pose.orientation;
        return builder.add(std::move(node));
    }
};

inline scene::Material matte(vec3 color) {
    scene::Material material;
    material.base_color = vec4(color, 1.0f);
    material.metallic = 0.0f;
    return material;
}

inline scene::Material metal(vec3 color, float roughness) {
    scene::Material material;
    material.base_color = vec4(color, 1.0f);
    material.roughness = roughness;
    return material;
}

inline scene::Material unlit(vec3 color, float alpha = 1.0f) {
    scene::Material material;
    material.base_color = vec4(color, alpha);
    material.unlit = true;
    if (alpha < 1.0f) material.alpha_mode = scene::AlphaMode::Blend;
    return material;
}

}  // namespace foveray::render
