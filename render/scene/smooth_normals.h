#pragma once

#include "render/scene/mesh.h"

namespace foveray::scene {

/// Gives a primitive without normals the means of its triangles' normals, weighted by the angle at the
/// corner, over all triangles that meet in a point and differ by less than the crease angle (radians).
/// Vertices at creases are split; seams of uv0 stay smooth. Triangles without area are left out, and vertices
/// without triangles. Uses positions, uv0, colors and indices.
void make_smooth_normals(Primitive& primitive, float crease);

}  // namespace foveray::scene
