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
    vec3 tint{1.0f};                 // multiplies the base colour
};

/// Where the ray meets the shape's surface between its ends, in order. `values` are the shape's parameters.
/// - Spheres, boxes, planes: in closed form. A plane's checker pattern is not filtered.
/// - CSG: each operation joins the two sets of intervals that its operands cut out of the line.
/// - Fractals and blends: by a march in steps of 1/2000 of the bounds' diagonal, so that what is thinner may
///   be missed (march.h).
/// - Voxels: the first voxel that the ray enters, at full resolution (voxel_tracer.h).
/// Throws Fault(Internal) for a user's shape, whose surface only its GLSL tells.
std::vector<Crossing> crossings(const scene::Shape& shape, std::span<const float> values, const Ray& ray);

}  // namespace foveray::reference
