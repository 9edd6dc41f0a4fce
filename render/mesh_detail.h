#pragma once

#include <span>
#include <vector>

#include "base/frame.h"
#include "base/headset_profile.h"
#include "base/settings.h"
#include "render/foveation.h"
#include "render/scene/mesh.h"
#include "shaders/shared/polar.h"

namespace foveray::render {

/// How finely a frame looks at what stands where: chooses the level of detail of meshes. A function of the
/// frame alone, so that replays repeat it.
class MeshDetail {
  public:
    /// An eye's own gaze goes to the fixation point, which only the GPU knows: it is at most this far off the
    /// gaze ray's direction (half of an interpupillary distance, a hand's length away), the gaze's change
    /// within a frame included.
    static constexpr float gaze_margin = 8.0f;  // degrees
    /// Errors in mirrors are less looked at than the things themselves, but a mirror may be where the gaze
    /// is: how many times the error may be there, in samples of the greatest density.
    static constexpr float mirrored_error = 4.0f;

    /// Full detail for everything.
    MeshDetail() = default;
    MeshDetail(const Frame& frame, const Pose& world_from_stage, const Fovea& fovea, const Acuity& acuity,
               const Settings& settings, bool every_pixel);

    /// The last of the levels whose error is small enough at the instance's nearest point to an eye.
    /// `errors`: of levels 0, 1, …, object space, not decreasing, the first 0. `bounds`: object space.
    std::uint32_t level(std::span<const float> errors, const scene::Aabb& bounds,
                        const mat4& world_from_object) const;

    /// Greatest error in world space, metres, that something within `radius` of `center` may have.
    float allowed_error(vec3 center, float radius) const;

  private:
    /// Distance between neighbouring samples, radians.
    float spacing(float eccentricity_degrees) const;

    std::vector<vec3> eyes_;
    vec3 gaze_{0.0f, 0.0f, -1.0f};
    bool every_pixel_ = false;
    shared::PolarMap map_{};
    float finest_spacing_ = 0.0f;  // radians
    float error_ = 0.0f;           // samples
    bool mirrors_ = true;
};

}  // namespace foveray::render
