#pragma once

#include "render/scene/made_mesh.h"

/// The kinds of made meshes; made_mesh.cpp has their parameters, docs/scene-format.md their meaning.
namespace foveray::scene {

Primitive make_lathe(const MadeMesh& mesh);
Primitive make_tube(const MadeMesh& mesh);
Primitive make_torus_knot(const MadeMesh& mesh);
Primitive make_rounded_box(const MadeMesh& mesh);
Primitive make_boulder(const MadeMesh& mesh);
Primitive make_panels(const MadeMesh& mesh);
Primitive make_tiles(const MadeMesh& mesh);
Primitive make_blend_surface(const MadeMesh& mesh);
Primitive make_gyroid(const MadeMesh& mesh);
Primitive make_acuity_patches(const MadeMesh& mesh);
Primitive make_digits(const MadeMesh& mesh);

}  // namespace foveray::scene
