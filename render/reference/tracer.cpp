#include "render/reference/tracer.h"

#include <algorithm>

#include "render/reference/surface.h"
#include "render/scene/deform.h"

namespace foveray::reference {

Tracer::Tracer(const scene::Scene& scene, const scene::SceneChanges& now, What what) : scene_(&scene) {
    if (what == What::Instances) {
        for (std::size_t id = 0; id < scene.instances.size(); ++id) {
            const scene::Instance& instance = scene.instances[id];
            if (!now.instances[id].present) continue;
            add(scene.meshes[instance.mesh], now.instances[id].world_from_object,
                instance.deformation ? &now.deformations[*instance.deformation] : nullptr, triangles_);
        }
        for (std::size_t id = 0; id < scene.shape_instances.size(); ++id) {
            const scene::ShapeId shape = scene.shape_instances[id].shape;
            if (!now.shape_instances[id].present) continue;
            const glm::dmat4 world(now.shape_instances[id].world_from_object);
            shapes_.push_back({&scene.shapes[shape], now.shapes[shape].values, glm::inverse(world)});
        }
    } else {
        const mat4 world_from_stage = to_matrix(scene.world_from_stage);
        for (const scene::RealSurface& surface : scene.real_surfaces) {
            add(scene.meshes[surface.mesh], world_from_stage * surface.stage_from_object, nullptr,
                triangles_);
        }
    }
    bvh_.emplace(triangles_);
}

void Tracer::add(const scene::Mesh& mesh, const mat4& world_from_object,
                 const scene::DeformationState* deformation, std::vector<Triangle>& triangles) {
    const glm::dmat4 world(world_from_object);
    const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(world)));
    const auto object = static_cast<std::uint32_t>(objects_.size());
    objects_.push_back({&mesh, glm::determinant(world) < 0.0, {}});
    for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
        const scene::Primitive& primitive = mesh.primitives[p];
        scene::DeformedVertices vertices{primitive.positions, primitive.normals, {}};
        if (deformation) vertices = scene::deform(primitive, deformation->joints, deformation->morph_weights);
        for (vec3& normal : vertices.normals) normal = vec3(glm::normalize(normal_matrix * dvec3(normal)));
        objects_.back().normals.push_back(std::move(vertices.normals));
        for (std::uint32_t t = 0; t < primitive.indices.size() / 3; ++t) {
            Triangle triangle;
            for (int k = 0; k < 3; ++k) {
                const vec3 position =
                    vertices.positions[primitive.indices[3 * t + static_cast<std::uint32_t>(k)]];
                triangle[static_cast<std::size_t>(k)] = dvec3(world * glm::dvec4(position, 1.0));
            }
            triangles.push_back(triangle);
            sources_.push_back({object, p, t});
        }
    }
}

const std::uint32_t* Tracer::corners(const Source& source) const {
    return &objects_[source.object].mesh->primitives[source.primitive].indices[3 *
                                                                               std::size_t{source.triangle}];
}

float Tracer::opacity(const TriangleHit& hit) const {
    const Source& source = sources_[hit.triangle];
    const scene::Primitive& primitive = objects_[source.object].mesh->primitives[source.primitive];
    const scene::Material& material = scene_->materials[primitive.material];
    if (material.alpha_mode == scene::AlphaMode::Opaque) return 1.0f;
    const float alpha = base_color(*scene_, primitive, corners(source), hit.u, hit.v).a;
    if (material.alpha_mode == scene::AlphaMode::Mask) return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
    return std::clamp(alpha, 0.0f, 1.0f);
}

Hit Tracer::describe(const Ray& ray, const TriangleHit& hit) const {
    const Source& source = sources_[hit.triangle];
    const Object& object = objects_[source.object];
    const scene::Primitive& primitive = object.mesh->primitives[source.primitive];
    const Triangle& t = triangles_[hit.triangle];
    const std::vector<vec3>& normals = object.normals[source.primitive];
    Hit out;
    out.distance = hit.distance;
    out.position = ray.origin + hit.distance * ray.direction;
    out.shading_normal = glm::normalize(interpolate(normals, corners(source), hit.u, hit.v, vec3(0, 1, 0)));
    const dvec3 winding = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    const dvec3 geometric = object.mirrored ? -winding : winding;
    out.geometric_normal = vec3(geometric);
    out.front = glm::dot(ray.direction, geometric) < 0.0;
    out.object = source.object;
    out.primitive = source.primitive;
    out.triangle = source.triangle;
    out.material = primitive.material;
    out.barycentrics = {hit.u, hit.v};
    out.uv0 = interpolate(primitive.uv0, corners(source), hit.u, hit.v, vec2(0.0f));
    out.base_color = base_color(*scene_, primitive, corners(source), hit.u, hit.v);
    return out;
}

std::optional<Hit> Tracer::closest(const Ray& ray, Side side) const {
    std::optional<TriangleHit> nearest;
    bvh_->visit_hits(ray, [&](const TriangleHit& hit) {
        const bool farther = nearest && hit.distance >= nearest->distance;
        const auto is_culled = [&] {
            if (side == Side::Both) return false;
            const Hit seen = describe(ray, hit);
            return !seen.front && !scene_->materials[seen.material].double_sided;
        };
        if (!farther && opacity(hit) > 0.0f && !is_culled()) nearest = hit;
        return nearest ? nearest->distance : ray.farthest;
    });
    Ray until = ray;
    if (nearest) until.farthest = nearest->distance;
    if (const std::optional<ShapeHit> shape = closest_shape(until, side)) return describe(ray, *shape);
    if (!nearest) return std::nullopt;
    return describe(ray, *nearest);
}

double Tracer::transmittance(const Ray& ray) const {
    double through = 1.0;
    bvh_->visit_hits(ray, [&](const TriangleHit& hit) {
        through *= 1.0 - opacity(hit);
        return through > 0.0 ? ray.farthest : -1.0;
    });
    for (std::uint32_t shape = 0; shape < shapes_.size() && through > 0.0; ++shape) {
        for (const ShapeHit& hit : shape_hits(ray, shape)) through *= 1.0 - opacity(hit);
    }
    return through;
}

std::vector<Tracer::ShapeHit> Tracer::shape_hits(const Ray& ray, std::uint32_t shape) const {
    Ray in_object = ray;
    in_object.origin = dvec3(shapes_[shape].object_from_world * glm::dvec4(ray.origin, 1.0));
    in_object.direction = glm::dmat3(shapes_[shape].object_from_world) * ray.direction;
    std::vector<ShapeHit> result;
    for (const Crossing& crossing : crossings(*shapes_[shape].shape, shapes_[shape].values, in_object)) {
        result.push_back({crossing, shape});
    }
    return result;
}

std::optional<Tracer::ShapeHit> Tracer::closest_shape(const Ray& ray, Side side) const {
    std::optional<ShapeHit> nearest;
    Ray until = ray;
    for (std::uint32_t shape = 0; shape < shapes_.size(); ++shape) {
        for (const ShapeHit& hit : shape_hits(until, shape)) {
            const bool culled = side == Side::FrontOnly && hit.crossing.inside &&
                                !scene_->materials[hit.crossing.material].double_sided;
            if (culled) continue;
            nearest = hit;
            until.farthest = hit.crossing.distance;
            break;
        }
    }
    return nearest;
}

float Tracer::opacity(const ShapeHit& hit) const {
    const scene::Material& material = scene_->materials[hit.crossing.material];
    return material.alpha_mode == scene::AlphaMode::Blend ? std::clamp(material.base_color.a, 0.0f, 1.0f)
                                                          : 1.0f;
}

Hit Tracer::describe(const Ray& ray, const ShapeHit& hit) const {
    const PlacedShape& shape = shapes_[hit.shape];
    const scene::Material& material = scene_->materials[hit.crossing.material];
    Hit out;
    out.distance = hit.crossing.distance;
    out.position = ray.origin + out.distance * ray.direction;
    const glm::dmat3 normal_matrix = glm::transpose(glm::dmat3(shape.object_from_world));
    out.geometric_normal = vec3(glm::normalize(normal_matrix * hit.crossing.normal));
    out.shading_normal = out.geometric_normal;
    out.front = !hit.crossing.inside;
    out.object = static_cast<std::uint32_t>(objects_.size()) + hit.shape;
    out.material = hit.crossing.material;
    out.base_color = material.base_color;
    if (hit.crossing.base_color) out.base_color = vec4(*hit.crossing.base_color, out.base_color.a);
    out.base_color *= vec4(hit.crossing.tint, 1.0f);
    return out;
}

}  // namespace foveray::reference
