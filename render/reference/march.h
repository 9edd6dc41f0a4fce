#pragma once

#include <optional>
#include <vector>

#include "render/reference/fields.h"
#include "render/reference/shape_tracer.h"

namespace foveray::reference {

struct SideChange {
    double distance = 0.0;
    bool leaves = false;  // the ray comes from inside
};

/// Where the ray first goes in or out, between its nearest and farthest distance: found by steps of `step`,
/// then halved. What is thinner than a step may be missed.
std::optional<SideChange> first_side_change(const Ray& ray, const IsInside& is_inside, double step);

/// Every such place, with the field's gradient as the normal.
std::vector<Crossing> through_field(const Ray& ray, const Field& field, double step);

/// Some of `count` points spread through the ball round p is inside, and some is not.
bool has_both_sides(const IsInside& is_inside, const dvec3& p, double radius, int count);

}  // namespace foveray::reference
