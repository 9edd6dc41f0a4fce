#include "render/reference/shape_tracer.h"

#include <algorithm>
#include <cmath>

#include "render/reference/csg.h"

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

/// The checker pattern is not filtered.
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
        default:
            return {};  // no closed form
    }
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
