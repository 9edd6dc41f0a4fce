#include "app/quality_control.h"

#include <algorithm>
#include <cmath>

#include "base/quality.h"

namespace foveray::app {
namespace {

float angle_between(const quat& a, const quat& b) {
    return 2.0f * std::acos(std::min(std::abs(glm::dot(a, b)), 1.0f));
}

}  // namespace

float QualityControl::head_speed(const Frame& frame, double seconds) {
    float speed = 0.0f;
    const quat& head = frame.stage_from_head.orientation;
    if (last_head_ && frame.head_valid && seconds > 0.0)
        speed = angle_between(*last_head_, head) / static_cast<float>(seconds);
    last_head_ = frame.head_valid ? std::optional(head) : std::nullopt;
    return speed;
}

Settings QualityControl::choose(const Settings& wanted, const Frame& frame,
                                const std::optional<FrameMetrics>& newest) {
    const std::optional<QualityLevel> level = named_level(wanted);
    Settings settings = level ? with_level(wanted, *level) : wanted;
    const double seconds = last_time_ ? to_seconds(frame.time - *last_time_) : 0.0;
    const float speed = head_speed(frame, seconds);
    last_time_ = frame.time;

    render::RayBudgetInput input;
    if (newest) {
        while (!traced_.empty() && traced_.front().index < newest->index) traced_.pop_front();
        if (!traced_.empty() && traced_.front().index == newest->index) {
            input.finished = {newest->gpu_ms(), traced_.front().choice};
            traced_.pop_front();
        }
    }
    if (wanted.gpu_share == 0.0f || frame.period <= 0) return settings;
    input.budget_ms = static_cast<double>(wanted.gpu_share) * 1e3 * to_seconds(frame.period);
    input.least_scale = wanted.least_scale;
    input.head_speed = speed;
    input.seconds = seconds;
    input.chooses_level = wanted.quality_level == "automatic";
    const render::RayChoice choice = budget_.update(input);
    traced_.push_back({frame.index, choice});
    settings.resolution_scale *= choice.scale;
    return input.chooses_level ? with_samples_of(settings, choice.level) : settings;
}

Settings replay_settings(const Settings& wanted, const Session& session, Nanoseconds time) {
    if (const auto level = named_level(wanted)) return with_level(wanted, *level);
    const auto recorded = session.quality_at(time);
    if (!recorded || wanted.quality_level == "manual") return wanted;
    static const Settings defaults;
    Settings settings = wanted;
    const auto take = [&](auto member, auto value) {
        if (wanted.*member == defaults.*member) settings.*member = value;
    };
    take(&Settings::resolution_scale, recorded->resolution_scale);
    take(&Settings::shadow_samples, recorded->shadow_samples);
    take(&Settings::ambient_occlusion_samples, recorded->ambient_occlusion_samples);
    take(&Settings::probe_rays, recorded->probe_rays);
    take(&Settings::second_ray_depth, recorded->second_ray_depth);
    return settings;
}

Session::QualitySample quality_sample(const Settings& settings, Nanoseconds time) {
    return {time,
            settings.resolution_scale,
            settings.shadow_samples,
            settings.ambient_occlusion_samples,
            settings.probe_rays,
            settings.second_ray_depth};
}

}  // namespace foveray::app
