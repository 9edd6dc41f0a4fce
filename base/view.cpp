#include "base/view.h"

#include <cmath>

namespace foveray {

vec3 direction_at(const Fov& fov, vec2 uv) {
    const float l = std::tan(fov.left), r = std::tan(fov.right);
    const float u = std::tan(fov.up), d = std::tan(fov.down);
    return {l + (r - l) * uv.x, u + (d - u) * uv.y, -1.0f};
}

vec2 uv_of(const Fov& fov, vec3 direction) {
    const float l = std::tan(fov.left), r = std::tan(fov.right);
    const float u = std::tan(fov.up), d = std::tan(fov.down);
    const float x = direction.x / -direction.z, y = direction.y / -direction.z;
    return {(x - l) / (r - l), (y - u) / (d - u)};
}

float centre_ppd(const Fov& fov, std::uint32_t width) {
    return static_cast<float>(width) / (std::tan(fov.right) - std::tan(fov.left)) * radians(1.0f);
}

mat4 clip_from_eye(const Fov& fov, float near_z, float far_z) {
    const float l = std::tan(fov.left), r = std::tan(fov.right);
    const float u = std::tan(fov.up), d = std::tan(fov.down);
    mat4 m(0.0f);
    m[0][0] = 2.0f / (r - l);
    m[2][0] = (r + l) / (r - l);
    m[1][1] = 2.0f / (d - u);
    m[2][1] = (d + u) / (d - u);
    m[2][2] = -far_z / (far_z - near_z);
    m[3][2] = -far_z * near_z / (far_z - near_z);
    m[2][3] = -1.0f;
    return m;
}

}  // namespace foveray
