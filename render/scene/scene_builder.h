#pragma once

#include <filesystem>
#include <vector>

#include "render/scene/scene.h"

namespace foveray::scene {

/// The one way to make a Scene, for loaders, generators and tests. Ids are given in the order of the calls;
/// what an object refers to must have been added before it (an assert otherwise). `build` completes the
/// meshes (flat normals where absent, tangents where a normal texture needs them, bounds) and derives
/// instances and deformations.
class SceneBuilder {
  public:
    /// `files`: takes the name of every file that is read into the scene, before it is; may be null.
    explicit SceneBuilder(std::vector<std::filesystem::path>* files = nullptr);

    /// Loaders tell the files that they read.
    void note_file(const std::filesystem::path& file);
    std::vector<std::filesystem::path>* files() const { return files_; }

    ImageId add(TextureImage image);
    TextureId add(Texture texture);
    MaterialId add(Material material);
    MeshId add(Mesh mesh);
    ShapeId add(Shape shape);
    UserShapeId add(UserShape shape);
    NodeId add(Node node);
    SkinId add(Skin skin);
    void add(Animation animation);
    LightId add(Light light);
    AreaLightId add(AreaLight light);
    CameraId add(Camera camera);
    void add(RealSurface surface);

    void set_skin(NodeId node, SkinId skin);  // skins name nodes, and nodes skins: nodes come first
    void set_local(NodeId node, const Transform& parent_from_node);
    void set(Environment environment);
    void set(const ProbeGrid& probes) { scene_.probes = probes; }
    void set_world_from_stage(const Pose& pose);
    /// Logs the text and keeps it in Scene::warnings.
    void warn(std::string text);

    const Scene& so_far() const { return scene_; }
    /// World bounds of what stands in the scene so far, at time 0.
    Aabb bounds();
    Scene build() &&;

  private:
    void derive();
    void derive_shape_instances(NodeId node);

    Scene scene_;
    std::vector<std::filesystem::path>* files_;
};

/// All instances of a scene at time 0, baked into one mesh in world space with material 0.
Mesh flatten(const Scene& scene);
/// A rectangle in the xz plane with normal +y, centred at the origin.
Mesh make_rectangle(vec2 half_size_xz);
/// An axis-aligned box centred at the origin, normals outwards.
Mesh make_box(vec3 half_size);
/// A latitude-longitude sphere with smooth normals and uv0.
Mesh make_sphere(float radius, std::uint32_t segments);

}  // namespace foveray::scene
