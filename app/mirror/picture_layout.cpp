#include "app/mirror/picture_layout.h"

#include <cmath>

namespace foveray::app {

Rect fit(const Rect& area, float aspect) {
    const vec2 room = area.size();
    const vec2 size =
        room.x > room.y * aspect ? vec2(room.y * aspect, room.y) : vec2(room.x, room.x / aspect);
    const vec2 min = area.min + (room - size) * 0.5f;
    return {min, min + size};
}

float aspect_of(const Fov& fov) {
    return (std::tan(fov.right) - std::tan(fov.left)) / (std::tan(fov.up) - std::tan(fov.down));
}

Rect place_within(const Fov& inner, const Fov& outer) {
    return {uv_of(outer, direction_at(inner, {0.0f, 0.0f})), uv_of(outer, direction_at(inner, {1.0f, 1.0f}))};
}

Rect part_of(const Rect& whole, const Rect& part) {
    return {whole.min + part.min * whole.size(), whole.min + part.max * whole.size()};
}

}  // namespace foveray::app
