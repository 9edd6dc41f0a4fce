#include "base/quality.h"

#include <array>
#include <cstddef>
#include <utility>

namespace foveray {
namespace {

struct Counts {
    int shadow_samples, ambient_occlusion_samples, probe_rays, second_ray_depth;
};

constexpr std::array<Counts, 4> levels = {{
    {1, 1, 32, 1},    // Low
    {4, 1, 64, 1},    // Medium
    {16, 2, 128, 2},  // High
    {64, 4, 256, 4},  // Best
}};

void take(Settings& settings, int Settings::*count, int value) {
    static const Settings defaults;
    if (settings.*count == defaults.*count) settings.*count = value;
}

}  // namespace

std::optional<QualityLevel> named_level(const Settings& settings) {
    if (settings.quality_level == "low") return QualityLevel::Low;
    if (settings.quality_level == "medium") return QualityLevel::Medium;
    if (settings.quality_level == "high") return QualityLevel::High;
    if (settings.quality_level == "best") return QualityLevel::Best;
    return std::nullopt;
}

Settings with_level(Settings settings, QualityLevel level) {
    settings = with_samples_of(std::move(settings), level);
    const Counts& counts = levels[static_cast<std::size_t>(level)];
    take(settings, &Settings::probe_rays, counts.probe_rays);
    take(settings, &Settings::second_ray_depth, counts.second_ray_depth);
    return settings;
}

Settings with_samples_of(Settings settings, QualityLevel level) {
    const Counts& counts = levels[static_cast<std::size_t>(level)];
    take(settings, &Settings::shadow_samples, counts.shadow_samples);
    take(settings, &Settings::ambient_occlusion_samples, counts.ambient_occlusion_samples);
    return settings;
}

}  // namespace foveray
