#include "render/scene/node.h"

namespace foveray::scene {

mat4 to_matrix(const Transform& t) {
    mat4 m = glm::mat4_cast(t.rotation);
    for (int axis = 0; axis < 3; ++axis) m[axis] *= t.scale[axis];
    m[3] = vec4(t.translation, 1.0f);
    return m;
}

}  // namespace foveray::scene
