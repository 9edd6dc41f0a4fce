#include "render/scene/load_scene.h"

#include <algorithm>
#include <cctype>

#include "render/scene/gltf_loader.h"
#include "render/scene/scene_builder.h"
#include "render/scene/scene_file.h"

namespace foveray::scene {
namespace {

/// On the floor, its middle 1.5 m in front of the origin, at a size that can be looked at in a room.
Transform placed_for_viewing(const Aabb& bounds) {
    constexpr float distance = 1.5f, largest = 3.0f, smallest = 0.1f, comfortable = 1.2f;
    const vec3 extent = bounds.extent();
    const float size = std::max({extent.x, extent.y, extent.z});
    Transform t;
    if (size > 0.0f && (size > largest || size < smallest)) t.scale = vec3(comfortable / size);
    if (!bounds.empty()) {
        const vec3 foot(bounds.center().x, bounds.min.y, bounds.center().z);
        t.translation = vec3(0.0f, 0.0f, -distance) - t.scale * foot;
    }
    return t;
}

void add_sun(SceneBuilder& builder) {
    Light sun;
    sun.name = "default sun";
    sun.kind = LightKind::Directional;
    sun.intensity = vec3(2.5f);
    Node node;
    node.name = sun.name;
    node.local.rotation =
        glm::angleAxis(radians(35.0f), vec3(0, 1, 0)) * glm::angleAxis(radians(-55.0f), vec3(1, 0, 0));
    node.light = builder.add(std::move(sun));
    builder.add(std::move(node));
}

Scene load_bare_gltf(const std::filesystem::path& file, std::vector<std::filesystem::path>* files) {
    SceneBuilder builder(files);
    Node root;
    root.name = file.stem().string();
    GltfModel::Use use;
    use.parent = builder.add(std::move(root));
    GltfModel model(builder, file);
    model.instantiate(use);
    builder.set_local(*use.parent, placed_for_viewing(builder.bounds()));
    if (builder.so_far().lights.empty()) add_sun(builder);

    RealSurface floor;
    floor.name = "floor";
    floor.mesh = builder.add(make_rectangle(vec2(5.0f)));
    builder.add(std::move(floor));
    return std::move(builder).build();
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, std::vector<std::filesystem::path>* files) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension == ".gltf" || extension == ".glb" ? load_bare_gltf(file, files)
                                                       : load_scene_file(file, files);
}

}  // namespace foveray::scene
