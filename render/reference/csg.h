#pragma once

#include <vector>

#include "render/reference/shape_tracer.h"

namespace foveray::reference {

/// A part of a line inside a solid, with what bounds it. May start or end at infinity.
struct Interval {
    Crossing entry, exit;
};

/// Disjoint, in order.
using Intervals = std::vector<Interval>;

/// What a line has in common with |p| <= radius, with |p| <= half_size in each component, and with the unit
/// cylinder round y. Crossings have no material.
Intervals through_sphere(double radius, const Ray& line);
Intervals through_box(const dvec3& half_size, const Ray& line);
Intervals through_cylinder(const Ray& line);

/// The whole line against a solid; leaves without a material get `otherwise`.
Intervals through_solid(const scene::CsgSolid& solid, scene::MaterialId otherwise, const Ray& line);

}  // namespace foveray::reference
