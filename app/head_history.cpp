#include "app/head_history.h"

#include <algorithm>

namespace foveray::app {

void HeadHistory::add(Nanoseconds time, const Pose& stage_from_head) {
    samples_.push_back({time, stage_from_head});
    while (samples_.size() > 2 && samples_.front().time < time - nanoseconds_per_second) samples_.pop_front();
}

Pose HeadHistory::at(Nanoseconds time) const {
    if (samples_.empty()) return {};
    const auto after =
        std::find_if(samples_.begin(), samples_.end(), [&](const auto& s) { return s.time >= time; });
    if (after == samples_.end()) return samples_.back().stage_from_head;
    if (after == samples_.begin() || after->time == time) return after->stage_from_head;
    const auto before = after - 1;
    const double t =
        static_cast<double>(time - before->time) / static_cast<double>(after->time - before->time);
    return interpolate(before->stage_from_head, after->stage_from_head, static_cast<float>(t));
}

}  // namespace foveray::app
