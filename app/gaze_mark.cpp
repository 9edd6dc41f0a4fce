#include "app/gaze_mark.h"

#include <algorithm>
#include <cmath>

namespace foveray::app {

void draw_gaze_mark(Image& picture, vec2 place, bool valid) {
    const float size = static_cast<float>(std::min(picture.width, picture.height));
    const float radius = 0.03f * size, half_width = std::max(0.75f, 0.003f * size);
    const vec2 centre = place * vec2(picture.width, picture.height);
    const float strength = valid ? 0.9f : 0.35f;
    const vec3 color(255.0f, 72.0f, 64.0f);
    const int reach = static_cast<int>(radius + half_width) + 2;
    const int cx = static_cast<int>(centre.x), cy = static_cast<int>(centre.y);
    for (int y = std::max(0, cy - reach); y < std::min<int>(picture.height, cy + reach + 1); ++y) {
        for (int x = std::max(0, cx - reach); x < std::min<int>(picture.width, cx + reach + 1); ++x) {
            const float distance = glm::length(vec2(x + 0.5f, y + 0.5f) - centre);
            const float cover =
                strength * std::clamp(half_width + 0.5f - std::abs(distance - radius), 0.0f, 1.0f);
            std::uint8_t* pixel = picture.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
            for (int c = 0; c < 3; ++c) {
                pixel[c] = static_cast<std::uint8_t>(std::lround(pixel[c] + cover * (color[c] - pixel[c])));
            }
        }
    }
}

}  // namespace foveray::app
