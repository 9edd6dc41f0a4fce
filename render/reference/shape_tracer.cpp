#include "render/reference/shape_tracer.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "render/reference/csg.h"
#include "render/reference/march.h"
#include "render/reference/voxel_tracer.h"

namespace foveray::reference {
namespace {

Intervals through_oriented_box(std::span<const float> v, const Ray& ray) {
    const glm::dquat object_from_box(scene::rotation_of(v.subspan(3)));
    Ray in_box = ray;
    in_box.origin = glm::conjugate(object_from_box) * ray.origin;
    in_box.direction = glm::conjugate(object_from_box) * ray.direction;
    Intervals result = through_box(dvec3(v[0], v[1], v[2]), in_box);
    for (Interval& interval : result) {
        interval.entry.normal = object_from_box * interval.entry.normal;
        interval.exit.normal = object_from_box * interval.exit.normal;
    }
    return result;
}

std::vector<Crossing> through_plane(std::span<const float> v, const Ray& ray) {
    if (ray.direction.y == 0.0) return {};
    Crossing crossing;
    crossing.distance = -ray.origin.y / ray.direction.y;
    crossing.normal = {0, 1, 0};
    crossing.inside = ray.direction.y > 0.0;
    const dvec3 at = ray.origin + crossing.distance * ray.direction;
    if (std::abs(at.x) > v[0] || std::abs(at.z) > v[1]) return {};
    if (v[2] > 0.0f) {
        const auto cell =
            static_cast<long>(std::floor(at.x / v[2])) + static_cast<long>(std::floor(at.z / v[2]));
        if (cell % 2 != 0) crossing.base_color = vec3(v[3], v[4], v[5]);
    }
    return {crossing};
}

std::vector<Crossing> ends_of(const Intervals& intervals) {
    std::vector<Crossing> result;
    for (const Interval& interval : intervals) {
        result.push_back(interval.entry);
        result.push_back(interval.exit);
        result.back().inside = true;
    }
    return result;
}

/// A march through the part of the ray that is in the shape's bounds.
template <typename Tint>
std::vector<Crossing> marched(const scene::Shape& shape, std::span<const float> v, const Ray& ray,
                              const Field& field, const Tint& tint) {
    const scene::Aabb bounds = scene::bounds_of(shape, v);
    Ray centred = ray;
    centred.origin -= dvec3(bounds.center());
    const Intervals within = through_box(0.5 * dvec3(bounds.extent()), centred);
    if (within.empty()) return {};
    const double step = glm::length(dvec3(bounds.extent())) / glm::length(ray.direction) / 2000.0;
    Ray part = ray;  // begins outside the bounds, where a cut's plane may lie
    part.nearest = std::max(ray.nearest, within.front().entry.distance - step);
    part.farthest = std::min(ray.farthest, within.front().exit.distance + step);
    if (!(part.nearest < part.farthest)) return {};
    std::vector<Crossing> result = through_field(part, field, step);
    for (Crossing& crossing : result) crossing.tint = tint(ray.origin + crossing.distance * ray.direction);
    return result;
}

std::vector<Crossing> through_blend(const scene::Shape& shape, std::span<const float> v, const Ray& ray) {
    return marched(shape, v, ray, field_of(shape.blend_parts, v[0]),
                   [&](const dvec3& p) { return tint_of(shape.blend_parts, v[0], p); });
}

template <class Fractal>
std::vector<Crossing> through_fractal(const scene::Shape& shape, std::span<const float> v, const Ray& ray) {
    const Fractal fractal(v);
    return marched(shape, v, ray, field_of(fractal), [&](const dvec3& p) { return tint_of(fractal, p); });
}

std::vector<Crossing> through_voxels(const scene::Voxels& voxels, const Ray& ray) {
    const std::optional<Crossing> first = first_voxel(voxels, ray);
    return first ? std::vector{*first} : std::vector<Crossing>{};
}

std::vector<Crossing> all_crossings(const scene::Shape& shape, std::span<const float> v, const Ray& ray) {
    switch (shape.kind) {
        case scene::ShapeKind::Sphere:
            return ends_of(through_sphere(v[0], ray));
        case scene::ShapeKind::Box:
            return ends_of(through_box(dvec3(v[0], v[1], v[2]), ray));
        case scene::ShapeKind::OrientedBox:
            return ends_of(through_oriented_box(v, ray));
        case scene::ShapeKind::Plane:
            return through_plane(v, ray);
        case scene::ShapeKind::Csg:
            return ends_of(through_solid(shape.solid, shape.material, ray));
        case scene::ShapeKind::Julia:
            return through_fractal<scene::Julia>(shape, v, ray);
        case scene::ShapeKind::Mandelbulb:
            return through_fractal<scene::Mandelbulb>(shape, v, ray);
        case scene::ShapeKind::Blend:
            return through_blend(shape, v, ray);
        case scene::ShapeKind::Voxels:
            return through_voxels(*shape.voxels, ray);
        case scene::ShapeKind::User:
            break;
    }
    throw Fault(ExitCode::Internal, "shape \"" + shape.name + "\"",
                "the reference tracer cannot run a user's GLSL", "leave users' shapes out of the scene");
}

}  // namespace

std::vector<Crossing> crossings(const scene::Shape& shape, std::span<const float> values, const Ray& ray) {
    std::vector<Crossing> result = all_crossings(shape, values, ray);
    if (shape.kind != scene::ShapeKind::Csg) {
        for (Crossing& crossing : result) crossing.material = shape.material;
    }
    std::erase_if(
        result, [&](const Crossing& c) { return !(c.distance > ray.nearest && c.distance < ray.farthest); });
    return result;
}

}  // namespace foveray::reference
