#pragma once

#include <functional>
#include <optional>
#include <span>

#include "render/reference/bvh.h"
#include "render/scene/blend.h"
#include "render/scene/fractal.h"

namespace foveray::reference {

/// Whether a point, in object space, is inside a solid.
using IsInside = std::function<bool(const dvec3& p)>;

/// By iterating, so that what a renderer estimates of the distance is held against the set itself.
IsInside inside_of(const scene::Julia& julia);
IsInside inside_of(const scene::Mandelbulb& mandelbulb);
IsInside inside_of(std::span<const scene::BlendPart> parts, double smoothness);

/// Of a blend: as shaders/render/shapes/blend.glsl defines it, negative inside. Of an uneven scale the least
/// counts, but for boxes.
double blend_distance(std::span<const scene::BlendPart> parts, double smoothness, const dvec3& p);

struct Crossing {
    double distance = 0.0;
    bool leaves = false;  // the ray comes from inside
};

/// Where the ray first goes in or out, between its nearest and farthest distance: found by steps of `step`,
/// then halved. What is thinner than a step may be missed.
std::optional<Crossing> first_crossing(const Ray& ray, const IsInside& is_inside, double step);

/// Some of `count` points spread through the ball round p is inside, and some is not.
bool has_both_sides(const IsInside& is_inside, const dvec3& p, double radius, int count);

}  // namespace foveray::reference
