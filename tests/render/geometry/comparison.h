#pragma once

#include <vector>

#include "base/view.h"
#include "render/reference/tracer.h"
#include "shaders/shared/surface.h"

namespace foveray::render {

void expect_near(vec3 a, vec3 b, float tolerance, const char* what);

struct Comparison {
    int compared = 0, hits = 0, back_faces = 0;
    int other_object = 0;  // pixels that disagree on what is hit: a few on silhouettes may
};

/// Expects every pixel of the view to hold what the reference finds there, for a scene without normal maps.
/// The stage is the world.
Comparison compare(const std::vector<shared::Surface>& found, const reference::Tracer& tracer,
                   const View& view);

}  // namespace foveray::render
