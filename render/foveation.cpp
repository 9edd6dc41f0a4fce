#include "render/foveation.h"

#include <algorithm>
#include <cmath>

namespace foveray::render {
namespace {

vec3 turn(vec3 from, vec3 to, float t) {
    const float cosine = std::clamp(glm::dot(from, to), -1.0f, 1.0f);
    const float angle = std::acos(cosine);
    if (angle < 1e-4f) return glm::normalize(glm::mix(from, to, t));
    if (angle > pi - 1e-3f) return t < 0.5f ? from : to;  // opposite: no way is the shortest
    return (std::sin((1.0f - t) * angle) * from + std::sin(t * angle) * to) / std::sin(angle);
}

float span(Nanoseconds dt, Nanoseconds whole) {
    return static_cast<float>(to_seconds(dt) / to_seconds(whole));
}

}  // namespace

Fovea Foveation::update(const Frame& frame, const Settings& settings) {
    const Nanoseconds now = frame.time;
    const Nanoseconds dt = started_ ? std::max<Nanoseconds>(now - last_time_, 0) : 0;
    const bool tracked = frame.has_eye_tracking && settings.gaze_tracking;
    const bool valid = tracked && frame.gaze.valid;
    const Pose head_from_stage = inverse(frame.stage_from_head);

    if (valid) {
        gaze_origin_ = transform_point(head_from_stage, frame.gaze.origin);
        gaze_direction_ = glm::normalize(transform_direction(head_from_stage, frame.gaze.direction));
        gaze_time_ = now;
        gaze_seen_ = true;
        fixed_ = started_ ? std::max(fixed_ - span(dt, ease_back_time), 0.0f) : 0.0f;
    } else {
        const auto hold = from_seconds(settings.blink_hold_ms * 1e-3);
        const bool held = tracked && gaze_seen_ && now - gaze_time_ <= hold;
        // Only the part of this step that lies after the hold counts.
        const Nanoseconds late = tracked && gaze_seen_ ? std::min(dt, now - gaze_time_ - hold) : dt;
        if (!held) fixed_ = std::min(fixed_ + span(late, ease_out_time), 1.0f);
    }
    started_ = true;
    last_time_ = now;

    const float t = fixed_ * fixed_ * (3.0f - 2.0f * fixed_);
    Fovea fovea;
    fovea.origin = transform_point(frame.stage_from_head, glm::mix(gaze_origin_, vec3(0.0f), t));
    fovea.direction =
        transform_direction(frame.stage_from_head, turn(gaze_direction_, vec3(0.0f, 0.0f, -1.0f), t));
    fovea.radius_degrees = t * settings.fixed_fovea_degrees;
    fovea.follows_gaze = valid && fixed_ == 0.0f;
    return fovea;
}

}  // namespace foveray::render
