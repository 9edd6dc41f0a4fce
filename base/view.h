#pragma once

#include <cstdint>

#include "base/math.h"

namespace foveray {

/// Half-angles in radians with OpenXR's signs: left and down are usually negative.
struct Fov {
    float left = 0.0f;
    float right = 0.0f;
    float up = 0.0f;
    float down = 0.0f;

    bool operator==(const Fov&) const = default;
};

enum class Eye : std::uint32_t { Left = 0, Right = 1 };

/// A context view covers the whole field of view, a focus view a small, dense part of it.
enum class ViewRole : std::uint32_t { Context = 0, Focus = 1 };

/// One image to fill: a pinhole camera at the eye. Pixel (0, 0) is the top left one.
struct View {
    Eye eye = Eye::Left;
    ViewRole role = ViewRole::Context;
    Pose stage_from_eye;
    Fov fov;
    uvec2 size{0};  // pixels, of this frame's image rect
};

/// Direction in the eye's frame through an image position; uv (0, 0) is the top left corner, (1, 1) the
/// bottom right one. Not normalised: z is -1.
vec3 direction_at(const Fov& fov, vec2 uv);
/// The image position of a direction in the eye's frame; meaningless unless direction.z < 0.
vec2 uv_of(const Fov& fov, vec3 direction);
/// Pixels a degree where the view's axis meets its image plane, for an image of `width` pixels.
float centre_ppd(const Fov& fov, std::uint32_t width);
/// Depth in [0, 1] (0 near, 1 far), y of clip space down as in Vulkan.
mat4 clip_from_eye(const Fov& fov, float near_z, float far_z);

}  // namespace foveray
