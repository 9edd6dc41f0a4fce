#pragma once

#include <functional>
#include <span>

#include "base/math.h"
#include "render/scene/blend.h"
#include "render/scene/fractal.h"

namespace foveray::reference {

/// A number for each point of object space, 0 on a solid's surface and negative inside. How steep it is says
/// nothing.
using Field = std::function<double(const dvec3& p)>;

/// How far the last iterate is beyond the escape radius; with a cut plane, the distance beyond that if it is
/// more. By iterating, so that what a renderer estimates of the distance is held against the set itself.
Field field_of(const scene::Julia& julia);
Field field_of(const scene::Mandelbulb& mandelbulb);
/// A distance, as shaders/render/shapes/blend.glsl defines it. Of an uneven scale the least counts, but for
/// boxes.
Field field_of(std::span<const scene::BlendPart> parts, double smoothness);

/// Whether a point, in object space, is inside a solid.
using IsInside = std::function<bool(const dvec3& p)>;

IsInside inside_of(Field field);

/// What multiplies the material's colour at a point of the surface.
vec3 tint_of(const scene::Julia& julia, const dvec3& p);
vec3 tint_of(const scene::Mandelbulb& mandelbulb, const dvec3& p);
vec3 tint_of(std::span<const scene::BlendPart> parts, double smoothness, const dvec3& p);

}  // namespace foveray::reference
