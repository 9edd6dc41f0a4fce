#pragma once

#include <numbers>
#include <string>

#include "base/image.h"
#include "base/math.h"
#include "render/scene/ids.h"

namespace foveray::scene {

enum class LightKind : std::uint8_t { Directional, Point, Spot };

/// KHR_lights_punctual, in its node's frame: shines along -z from the origin.
struct Light {
    std::string name;
    LightKind kind = LightKind::Point;
    vec3 intensity{
        1.0f};  // colour times intensity: irradiance for directional, radiant intensity for the others
    float range = 0.0f;       // metres; 0: no limit
    float inner_cone = 0.0f;  // radians from the axis, Spot only
    float outer_cone = std::numbers::pi_v<float> / 4.0f;
};

enum class AreaLightShape : std::uint8_t {
    Rectangle,  // in its node's xy plane, shines to its -z side only
    Box,
    Sphere,  // of radius half_size.x; a scaled node's x axis counts
};

/// Light of the same radiance everywhere on it, centred at its node's origin.
struct AreaLight {
    std::string name;
    AreaLightShape shape = AreaLightShape::Rectangle;
    vec3 half_size{0.5f};  // metres along the node's axes
    vec3 radiance{1.0f};
};

/// A light where it stands in this frame, world space.
struct PlacedLight {
    LightKind kind = LightKind::Point;
    vec3 position{0.0f};
    vec3 direction{0.0f, 0.0f, -1.0f};  // unit, the way the light travels
    vec3 intensity{1.0f};
    float range = 0.0f;
    float cos_inner_cone = 1.0f;
    float cos_outer_cone = 0.0f;
    std::uint32_t number = 0;  // its own for good, whatever other lights come and go
};

/// A rectangle is center + a * half_u + b * half_v, a and b in [-1, 1], and shines to the side that
/// cross(half_u, half_v) points to; a box has half_w besides; a sphere's radius is half_u's length.
struct PlacedAreaLight {
    AreaLightShape shape = AreaLightShape::Rectangle;
    vec3 center{0.0f};
    vec3 half_u{0.5f, 0.0f, 0.0f};
    vec3 half_v{0.0f, -0.5f, 0.0f};
    vec3 half_w{0.0f, 0.0f, -0.5f};
    vec3 radiance{1.0f};
    std::uint32_t number = 0;  // as of PlacedLight; these come first
};

/// What rays see that leave the scene: a latitude-longitude picture in world space; see environment_uv.
struct Environment {
    FloatImage radiance;     // linear RGB, at least 1 x 1 (a constant)
    float intensity = 1.0f;  // multiplies radiance
    float rotation = 0.0f;   // radians round +y, counter-clockwise from above
};

Environment constant_environment(vec3 radiance);
/// A soft grey sky, brightest at the zenith, over a darker ground.
Environment default_sky();
/// Where a world direction falls in the picture: its middle column shows -z, u grows to the right, v = 0 is
/// +y.
vec2 environment_uv(const Environment& environment, vec3 world_direction);

}  // namespace foveray::scene
