#pragma once

#include <random>

#include "render/scene/scene_builder.h"

namespace foveray::render {

/// Boxes, spheres and rectangles under rotated, unevenly scaled, mirrored and sheared transforms, 2 to 8 m in
/// front of the origin, with one-sided and two-sided materials of different colours.
inline scene::SceneBuilder random_scene(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](float low, float high) {
        return low + (high - low) * (static_cast<float>(random() >> 8) / 16777216.0f);
    };
    const auto rotation = [&] {
        return glm::normalize(quat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
    };
    scene::SceneBuilder builder;
    std::vector<scene::MaterialId> materials;
    for (int i = 0; i < 6; ++i) {
        scene::Material material;
        material.base_color = {uniform(0, 1), uniform(0, 1), uniform(0, 1), 1};
        material.double_sided = i == 0 || i == 3 || i == 4;
        materials.push_back(builder.add(material));
    }
    std::vector<scene::MeshId> meshes;
    for (int i = 0; i < 7; ++i) {
        scene::Mesh mesh = i % 3 == 0   ? scene::make_box(vec3(0.5f))
                           : i % 3 == 1 ? scene::make_sphere(0.5f, 12)
                                        : scene::make_rectangle(vec2(0.7f));
        if (i == 6) mesh = scene::make_rectangle(vec2(0.7f));
        mesh.primitives[0].material = materials[i % 6];
        if (i == 5) {  // one-sided and two-sided geometry in one mesh
            mesh.primitives.push_back(scene::make_box(vec3(0.2f)).primitives[0]);
            mesh.primitives[1].material = materials[0];
        }
        meshes.push_back(builder.add(std::move(mesh)));
    }
    for (int i = 0; i < 28; ++i) {
        scene::Node parent;
        parent.local.translation = {uniform(-3, 3), uniform(-3, 3), uniform(-8, -2)};
        parent.local.rotation = rotation();
        parent.local.scale = {uniform(0.4f, 1.6f), uniform(0.4f, 1.6f), uniform(0.4f, 1.6f)};
        scene::Node child;
        child.parent = builder.add(parent);
        child.local.rotation = rotation();  // under an uneven scale: shear
        child.local.scale = {i % 3 == 0 ? -1.0f : 1.0f, uniform(0.5f, 1.5f), i % 5 == 0 ? -1.0f : 1.0f};
        child.mesh = meshes[i % 7];
        builder.add(child);
    }
    return builder;
}

}  // namespace foveray::render
