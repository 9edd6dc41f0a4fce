#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/scene/light.h"
#include "render/scene/material.h"
#include "render/scene/mesh.h"
#include "render/scene/node.h"
#include "render/scene/probe_grid.h"
#include "render/scene/user_shape.h"
#include "render/scene/shape.h"

namespace foveray::scene {

/// A mesh with its own changing vertices: skinned, morphed or both. One for each such node.
struct Deformation {
    NodeId node = 0;
    MeshId mesh = 0;
    std::optional<SkinId> skin;
    bool animated = false;  // false: deformed once, at the start
};

/// A mesh placed in the world. Order: by node id, then by EXT_mesh_gpu_instancing index.
struct Instance {
    NodeId node = 0;
    MeshId mesh = 0;
    mat4 node_from_object{1.0f};               // the transform by EXT_mesh_gpu_instancing, or the identity
    std::optional<DeformationId> deformation;  // then its vertices are the deformation's, not the mesh's
};

/// A shape placed in the world. Order: by node id, then by instancing index.
struct ShapeInstance {
    NodeId node = 0;
    ShapeId shape = 0;
    mat4 node_from_object{1.0f};
};

/// Something real that the wearer sees: it is invisible itself, receives virtual shadows and light, and hides
/// what is virtual and behind it. STAGE space, unlike everything else here.
struct RealSurface {
    std::string name;
    MeshId mesh = 0;  // planes and boxes are meshes too; never skinned or morphed; its materials mean nothing
    mat4 stage_from_object{1.0f};
    vec3 albedo{0.5f};         // diffuse, linear
    float reflectance = 0.0f;  // of a mirror at normal incidence, 0..1: above 0 it mirrors virtual things
    float roughness = 0.5f;    // of that mirror, perceptual
};

/// Everything that is drawn, as plain data that nothing changes after SceneBuilder::build. What moves, moves
/// in SceneAnimator. World space unless said otherwise.
struct Scene {
    std::vector<TextureImage> images;
    std::vector<Texture> textures;
    std::vector<Material> materials;  // never empty; material 0 is glTF's default material
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    std::vector<Shape> shapes;
    std::vector<UserShape> user_shapes;  // one a file
    std::vector<Skin> skins;
    std::vector<Animation> animations;  // all of them play
    std::vector<Light> lights;
    std::vector<AreaLight> area_lights;
    std::vector<Camera> cameras;
    Environment environment;
    std::vector<RealSurface> real_surfaces;
    std::optional<ProbeGrid> probes;
    Pose world_from_stage;

    std::vector<Deformation> deformations;       // derived, in node order
    std::vector<Instance> instances;             // derived
    std::vector<ShapeInstance> shape_instances;  // derived
    Aabb bounds;                                 // derived: of all instances at time 0, without real surfaces
    // Derived: what lies behind virtual things may be shadowed, mirrored on or tinted, not only covered.
    bool changes_what_is_behind = false;

    std::vector<std::string> warnings;  // what the loaders had to leave out; also logged
};

}  // namespace foveray::scene
