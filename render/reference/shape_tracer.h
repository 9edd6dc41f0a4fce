#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/reference/bvh.h"
#include "render/scene/scene.h"

namespace foveray::reference {

/// A place where a line passes through a shape's surface. Object space.
struct Crossing {
    double distance = 0.0;  // in lengths of the ray's direction
    dvec3 normal{0.0};      // outwards, unit length
    bool inside = false;    // the line leaves the shape here
    scene::MaterialId material = 0;
    std::optional<vec3> base_color;  // in place of the material's
};

/// Where the ray meets the shape's surface between its ends, in order, in closed form. `values` are the
/// shape's parameters. CSG: each operation joins the two sets of intervals that its operands cut out of the
/// line. Kinds that have no closed form give none: march.h has their own queries.
std::vector<Crossing> crossings(const scene::Shape& shape, std::span<const float> values, const Ray& ray);

}  // namespace foveray::reference
