#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

/// Right-handed, y up, -z forward, metres, radians. Transforms are named `destination_from_source`.
namespace foveray {

using glm::dvec3;
using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::uvec2;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr float pi = 3.14159265358979323846f;

constexpr float radians(float degrees) { return degrees * (pi / 180.0f); }
constexpr float degrees(float radians) { return radians * (180.0f / pi); }

/// A rigid transform.
struct Pose {
    quat orientation{1.0f, 0.0f, 0.0f, 0.0f};
    vec3 position{0.0f};

    bool operator==(const Pose&) const = default;
};

mat4 to_matrix(const Pose& pose);
Pose inverse(const Pose& pose);
/// a_from_c = a_from_b * b_from_c
Pose operator*(const Pose& a_from_b, const Pose& b_from_c);
vec3 transform_point(const Pose& a_from_b, vec3 point_b);
vec3 transform_direction(const Pose& a_from_b, vec3 direction_b);
/// Straight line for the position, shortest arc for the orientation; t in [0, 1].
Pose interpolate(const Pose& from, const Pose& to, float t);
/// Every component is finite and the quaternion can be normalised.
bool is_usable(const Pose& pose);

}  // namespace foveray
