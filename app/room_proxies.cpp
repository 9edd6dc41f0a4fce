#include "app/room_proxies.h"

#include <limits>

namespace foveray::app {

std::vector<shared::RoomProxy> room_proxies(const scene::Scene& scene) {
    std::vector<shared::RoomProxy> proxies;
    for (const scene::RealSurface& surface : scene.real_surfaces) {
        vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
        for (const auto& primitive : scene.meshes[surface.mesh].primitives) {
            for (const vec3& p : primitive.positions) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
        if (low.x > high.x) continue;
        const mat4& m = surface.stage_from_object;
        const vec3 half = 0.5f * (high - low);
        proxies.push_back({vec3(m * vec4(0.5f * (low + high), 1.0f)), vec3(m[0]) * half.x,
                           vec3(m[1]) * half.y, vec3(m[2]) * half.z});
    }
    return proxies;
}

}  // namespace foveray::app
