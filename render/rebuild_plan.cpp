#include "render/rebuild_plan.h"

#include <algorithm>
#include <bit>

namespace foveray::render {

std::uint32_t RebuildPlan::refits_between_builds(std::uint32_t primitives) {
    if (primitives <= always_rebuilt) return 0;
    return build_cost + static_cast<std::uint32_t>(std::bit_width(primitives));
}

RebuildPlan::RebuildPlan(std::vector<std::uint32_t> primitive_counts)
    : primitives_(std::move(primitive_counts)) {
    for (const std::uint32_t primitives : primitives_) refits_.push_back(refits_between_builds(primitives));
}

std::vector<bool> RebuildPlan::choose(std::span<const std::uint8_t> changed) {
    std::vector<bool> rebuild(primitives_.size(), false);
    std::vector<std::size_t> due;
    for (std::size_t i = 0; i < primitives_.size(); ++i) {
        if (!changed[i]) continue;
        if (primitives_[i] <= always_rebuilt) {
            rebuild[i] = true;
        } else if (refits_[i]++ >= refits_between_builds(primitives_[i])) {
            due.push_back(i);
        }
    }
    const auto overdue = [&](std::size_t i) { return refits_[i] - refits_between_builds(primitives_[i]); };
    std::ranges::stable_sort(due, std::ranges::greater(), overdue);
    std::uint64_t used = 0;
    for (const std::size_t i : due) {
        if (used > 0 && used + primitives_[i] > frame_budget) continue;
        used += primitives_[i];
        rebuild[i] = true;
        refits_[i] = 0;
    }
    return rebuild;
}

}  // namespace foveray::render
