#pragma once

#include "render/scene/scene_builder.h"
#include "tests/fakes/random.h"

namespace foveray::render {

/// Boxes, spheres and rectangles under rotated, unevenly scaled, mirrored and sheared transforms, 2 to 8 m in
/// front of the origin, with one-sided and two-sided materials of different colours.
inline scene::SceneBuilder random_scene(std::uint32_t seed) {
    fakes::Random random(seed);
    scene::SceneBuilder builder;
    std::vector<scene::MaterialId> materials;
    for (int i = 0; i < 6; ++i) {
        scene::Material material;
        material.base_color = vec4(random.vector(0, 1), 1);
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
        parent.local.translation = {random.in(-3, 3), random.in(-3, 3), random.in(-8, -2)};
        parent.local.rotation = random.rotation();
        parent.local.scale = random.vector(0.4f, 1.6f);
        scene::Node child;
        child.parent = builder.add(parent);
        child.local.rotation = random.rotation();  // under an uneven scale: shear
        child.local.scale = {i % 3 == 0 ? -1.0f : 1.0f, random.in(0.5f, 1.5f), i % 5 == 0 ? -1.0f : 1.0f};
        child.mesh = meshes[i % 7];
        builder.add(child);
    }
    return builder;
}

}  // namespace foveray::render
