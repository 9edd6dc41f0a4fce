#include "base/math.h"

#include <cmath>
#include <initializer_list>

namespace foveray {

mat4 to_matrix(const Pose& pose) {
    mat4 m = glm::mat4_cast(pose.orientation);
    m[3] = vec4(pose.position, 1.0f);
    return m;
}

Pose inverse(const Pose& pose) {
    const quat q = glm::conjugate(pose.orientation);
    return {q, q * -pose.position};
}

Pose operator*(const Pose& a_from_b, const Pose& b_from_c) {
    return {glm::normalize(a_from_b.orientation * b_from_c.orientation),
            a_from_b.position + a_from_b.orientation * b_from_c.position};
}

vec3 transform_point(const Pose& a_from_b, vec3 point_b) {
    return a_from_b.position + a_from_b.orientation * point_b;
}

vec3 transform_direction(const Pose& a_from_b, vec3 direction_b) {
    return a_from_b.orientation * direction_b;
}

Pose interpolate(const Pose& from, const Pose& to, float t) {
    return {glm::normalize(glm::slerp(from.orientation, to.orientation, t)),
            glm::mix(from.position, to.position, t)};
}

bool is_usable(const Pose& pose) {
    const quat& q = pose.orientation;
    const vec3& p = pose.position;
    for (float value : {q.x, q.y, q.z, q.w, p.x, p.y, p.z}) {
        if (!std::isfinite(value)) return false;
    }
    return glm::dot(q, q) > 1e-6f;
}

}  // namespace foveray
