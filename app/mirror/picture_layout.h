#pragma once

#include "base/math.h"
#include "base/view.h"

namespace foveray::app {

struct Rect {
    vec2 min{0.0f}, max{0.0f};

    vec2 size() const { return max - min; }
    bool contains(vec2 point) const {
        return glm::all(glm::greaterThanEqual(point, min)) && glm::all(glm::lessThan(point, max));
    }
};

/// The largest rectangle of width / height `aspect` in the middle of `area`.
Rect fit(const Rect& area, float aspect);
/// Width / height of the plane that a field of view cuts out.
float aspect_of(const Fov& fov);
/// Where the picture of `inner` lies on the picture of `outer` at the same pose, both in 0..1 from the top
/// left.
Rect place_within(const Fov& inner, const Fov& outer);
/// `part` is relative to `whole`, 0..1.
Rect part_of(const Rect& whole, const Rect& part);

}  // namespace foveray::app
