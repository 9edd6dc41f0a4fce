#pragma once

#include <optional>
#include <vector>

#include "render/reference/bvh.h"
#include "render/reference/shape_tracer.h"
#include "render/scene/animator.h"

namespace foveray::reference {

/// What a ray meets. World space; normals point to the front side of the triangle or out of the shape, also
/// when hit from behind.
struct Hit {
    double distance = 0.0;
    dvec3 position{0.0};
    vec3 geometric_normal{0.0f};
    vec3 shading_normal{0.0f};  // interpolated, without normal map
    bool front = true;
    std::uint32_t object =
        0;  // the instance's id, shapes after meshes; among real surfaces, the surface's index
    std::uint32_t primitive = 0;  // of the mesh: the geometry index of its BLAS
    std::uint32_t triangle = 0;   // of the primitive
    scene::MaterialId material = 0;
    vec2 barycentrics{0.0f};  // weights of corners 1 and 2
    vec2 uv0{0.0f};
    vec4 base_color{1.0f};  // linear, alpha as it comes
};

enum class Side { Both, FrontOnly };

/// Naive queries over one moment of a scene. Texels are taken from level 0, voxels at full resolution.
/// Scenes with users' shapes throw Fault(Internal) when a ray is asked for (shape_tracer.h).
class Tracer {
  public:
    enum class What { Instances, RealSurfaces };

    /// `world_from_stage` places real surfaces.
    Tracer(const scene::Scene& scene, const scene::SceneChanges& now, What what = What::Instances);

    /// The nearest surface whose alpha lets it be seen: with AlphaMode::Mask alpha >= the cutoff, with Blend
    /// alpha > 0. FrontOnly passes through the back of single-sided materials.
    std::optional<Hit> closest(const Ray& ray, Side side = Side::Both) const;
    /// The part of the light that gets through: 0 behind opaque surfaces, else the product of 1 - alpha, of
    /// shapes once at each side.
    double transmittance(const Ray& ray) const;

  private:
    struct Object {
        const scene::Mesh* mesh;
        bool mirrored;  // by its transform: the front stays what it is in object space
        std::vector<std::vector<vec3>> normals;  // world, a vector a primitive
    };
    struct Source {
        std::uint32_t object, primitive, triangle;
    };

    struct PlacedShape {
        const scene::Shape* shape;
        std::vector<float> values;
        glm::dmat4 object_from_world;
    };
    struct ShapeHit {
        Crossing crossing;
        std::uint32_t shape;  // index into shapes_
    };

    /// In order.
    std::vector<ShapeHit> shape_hits(const Ray& ray, std::uint32_t shape) const;
    std::optional<ShapeHit> closest_shape(const Ray& ray, Side side) const;
    float opacity(const ShapeHit& hit) const;
    Hit describe(const Ray& ray, const ShapeHit& hit) const;

    void add(const scene::Mesh& mesh, const mat4& world_from_object,
             const scene::DeformationState* deformation, std::vector<Triangle>& triangles);
    const std::uint32_t* corners(const Source& source) const;
    /// 0..1 by the alpha mode.
    float opacity(const TriangleHit& hit) const;
    Hit describe(const Ray& ray, const TriangleHit& hit) const;

    const scene::Scene* scene_;
    std::vector<Object> objects_;
    std::vector<PlacedShape> shapes_;
    std::vector<Source> sources_;
    std::vector<Triangle> triangles_;
    std::optional<Bvh> bvh_;
};

}  // namespace foveray::reference
