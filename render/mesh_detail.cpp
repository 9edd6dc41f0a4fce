#include "render/mesh_detail.h"

#include <algorithm>
#include <cmath>

#include "render/polar_map.h"
#include "render/sampling.h"

namespace foveray::render {

MeshDetail::MeshDetail(const Frame& frame, const Pose& world_from_stage, const Fovea& fovea,
                       const Acuity& acuity, const Settings& settings, bool every_pixel)
    : gaze_(transform_direction(world_from_stage, fovea.direction)),
      every_pixel_(every_pixel),
      map_(widen_fovea(make_polar_map(effective_acuity(acuity, settings), settings.resolution_scale,
                                      settings.angular_ratio),
                       fovea.radius_degrees)),
      error_(settings.mesh_error),
      mirrors_(settings.reflections) {
    float finest_pixel = 1e9f;
    for (const View& view : frame.views) {
        eyes_.push_back(transform_point(world_from_stage, view.stage_from_eye.position));
        finest_pixel = std::min(finest_pixel, radians(1.0f / centre_ppd(view.fov, view.size.x)));
    }
    const float sub_samples = std::sqrt(static_cast<float>(settings.reference_samples));
    finest_spacing_ = every_pixel ? finest_pixel / sub_samples : radians(polar_radial_spacing(map_, 0.0f));
}

float MeshDetail::spacing(float eccentricity_degrees) const {
    if (every_pixel_) return finest_spacing_;
    const float e = std::clamp(eccentricity_degrees - gaze_margin, 0.0f, map_.outer);
    return radians(polar_radial_spacing(map_, e));
}

float MeshDetail::allowed_error(vec3 center, float radius) const {
    float least = 1e9f;
    for (const vec3 eye : eyes_) {
        const float to_center = glm::distance(eye, center);
        if (to_center <= radius) return 0.0f;
        const float away = std::acos(std::clamp(glm::dot(center - eye, gaze_) / to_center, -1.0f, 1.0f));
        const float angle = spacing(degrees(away - std::asin(radius / to_center)));
        const float most = mirrors_ ? std::min(angle, mirrored_error * finest_spacing_) : angle;
        least = std::min(least, error_ * most * (to_center - radius));
    }
    return least;
}

std::uint32_t MeshDetail::level(std::span<const float> errors, const scene::Aabb& bounds,
                                const mat4& world_from_object) const {
    if (error_ <= 0.0f || errors.size() < 2 || eyes_.empty()) return 0;
    const float scale =
        std::max({glm::length(vec3(world_from_object[0])), glm::length(vec3(world_from_object[1])),
                  glm::length(vec3(world_from_object[2]))});
    const vec3 center(world_from_object * vec4(bounds.center(), 1.0f));
    const float allowed = allowed_error(center, 0.5f * scale * glm::length(bounds.extent()));
    const auto too_coarse = std::ranges::find_if(errors, [&](float e) { return e * scale > allowed; });
    return static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(too_coarse - errors.begin() - 1, 0));
}

}  // namespace foveray::render
