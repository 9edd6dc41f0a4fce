#include "render/scene/mesh.h"

namespace foveray::scene {

Aabb transformed(const Aabb& box, const mat4& to_from_box) {
    Aabb result;
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                     corner & 4 ? box.max.z : box.min.z);
        result.add(vec3(to_from_box * vec4(p, 1.0f)));
    }
    return result;
}

}  // namespace foveray::scene
