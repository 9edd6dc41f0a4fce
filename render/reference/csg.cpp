#include "render/reference/csg.h"

#include <cassert>
#include <cmath>

namespace foveray::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using glm::dmat3;
using glm::dmat4;

Crossing at(double distance, const dvec3& normal = dvec3(0.0)) {
    Crossing crossing;
    crossing.distance = distance;
    crossing.normal = normal;
    return crossing;
}

/// A slab |n·p| <= h with unit n.
Intervals through_slab(const dvec3& n, double h, const Ray& line) {
    const double o = glm::dot(n, line.origin), d = glm::dot(n, line.direction);
    if (d == 0.0) {
        if (std::abs(o) > h) return {};
        Interval all;
        all.entry.distance = -infinity;
        all.exit.distance = infinity;
        return {all};
    }
    const double sign = d > 0.0 ? 1.0 : -1.0;
    Interval slab;
    slab.entry = at((-sign * h - o) / d, -sign * n);
    slab.exit = at((sign * h - o) / d, sign * n);
    return {slab};
}

/// The quadratic |q + t r| = radius in the subspace that `project` keeps.
Intervals through_round(const dvec3& keep, double radius, const Ray& line) {
    const dvec3 q = keep * line.origin, r = keep * line.direction;
    const double a = glm::dot(r, r), b = glm::dot(q, r), c = glm::dot(q, q) - radius * radius;
    if (a == 0.0) {
        if (c > 0.0) return {};
        Interval all;
        all.entry.distance = -infinity;
        all.exit.distance = infinity;
        return {all};
    }
    const double discriminant = b * b - a * c;
    if (discriminant <= 0.0) return {};
    const double root = std::sqrt(discriminant);
    Interval round;
    round.entry.distance = (-b - root) / a;
    round.exit.distance = (-b + root) / a;
    for (Crossing* crossing : {&round.entry, &round.exit}) {
        crossing->normal = (q + crossing->distance * r) / radius;
    }
    return {round};
}

Intervals intersection(const Intervals& a, const Intervals& b) {
    Intervals result;
    for (const Interval& x : a) {
        for (const Interval& y : b) {
            const Interval both{x.entry.distance >= y.entry.distance ? x.entry : y.entry,
                                x.exit.distance <= y.exit.distance ? x.exit : y.exit};
            if (both.entry.distance < both.exit.distance) result.push_back(both);
        }
    }
    return result;
}

/// What is left of the line, with normals that point out of it.
Intervals complement(const Intervals& a) {
    const auto turned = [](Crossing crossing) {
        crossing.normal = -crossing.normal;
        return crossing;
    };
    Intervals result;
    Crossing start = at(-infinity);
    for (const Interval& x : a) {
        if (start.distance < x.entry.distance) result.push_back({start, turned(x.entry)});
        start = turned(x.exit);
    }
    if (start.distance < infinity) result.push_back({start, at(infinity)});
    return result;
}

Intervals combine(scene::CsgOperation operation, const Intervals& a, const Intervals& b) {
    if (operation == scene::CsgOperation::Intersection) return intersection(a, b);
    if (operation == scene::CsgOperation::Difference) return intersection(a, complement(b));
    return complement(intersection(complement(a), complement(b)));  // De Morgan
}

Intervals through_leaf(const scene::CsgLeaf& leaf, scene::MaterialId otherwise, const Ray& line) {
    const dmat4 leaf_from_object = glm::inverse(dmat4(leaf.object_from_leaf));
    Ray in_leaf = line;
    in_leaf.origin = dvec3(leaf_from_object * glm::dvec4(line.origin, 1.0));
    in_leaf.direction = dmat3(leaf_from_object) * line.direction;
    Intervals result = leaf.primitive == scene::CsgPrimitive::Sphere ? through_sphere(1.0, in_leaf)
                       : leaf.primitive == scene::CsgPrimitive::Box  ? through_box(dvec3(1.0), in_leaf)
                                                                     : through_cylinder(in_leaf);
    for (Interval& interval : result) {
        for (Crossing* crossing : {&interval.entry, &interval.exit}) {
            crossing->normal = glm::normalize(glm::transpose(dmat3(leaf_from_object)) * crossing->normal);
            crossing->material = leaf.material.value_or(otherwise);
        }
    }
    return result;
}

}  // namespace

Intervals through_sphere(double radius, const Ray& line) { return through_round(dvec3(1.0), radius, line); }

Intervals through_box(const dvec3& half_size, const Ray& line) {
    Intervals result = through_slab(dvec3(1, 0, 0), half_size.x, line);
    result = intersection(result, through_slab(dvec3(0, 1, 0), half_size.y, line));
    return intersection(result, through_slab(dvec3(0, 0, 1), half_size.z, line));
}

Intervals through_cylinder(const Ray& line) {
    return intersection(through_round(dvec3(1, 0, 1), 1.0, line), through_slab(dvec3(0, 1, 0), 1.0, line));
}

Intervals through_solid(const scene::CsgSolid& solid, scene::MaterialId otherwise, const Ray& line) {
    std::vector<Intervals> stack;
    for (const scene::CsgStep& step : solid.program) {
        if (!step.operation) {
            stack.push_back(through_leaf(solid.leaves[step.leaf], otherwise, line));
            continue;
        }
        const Intervals b = std::move(stack.back());
        stack.pop_back();
        stack.back() = combine(*step.operation, stack.back(), b);
    }
    assert(stack.size() == 1);
    return stack.front();
}

}  // namespace foveray::reference
