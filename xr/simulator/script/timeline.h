#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/time.h"

namespace foveray::simulator {

/// A value that changes at session times and holds in between. T() holds before the first change.
template <typename T>
class Timeline {
  public:
    /// From `time` on; later changes are forgotten.
    void set(Nanoseconds time, const T& value) {
        while (!changes_.empty() && changes_.back().time >= time) changes_.pop_back();
        constexpr std::size_t most = 100'000;
        if (changes_.size() == most) changes_.erase(changes_.begin(), changes_.begin() + most / 2);
        changes_.push_back({time, value});
    }
    T at(Nanoseconds time) const {
        const auto next = std::ranges::upper_bound(changes_, time, {}, &Change::time);
        return next == changes_.begin() ? T() : (next - 1)->value;
    }
    T last() const { return changes_.empty() ? T() : changes_.back().value; }

  private:
    struct Change {
        Nanoseconds time;
        T value;
    };
    std::vector<Change> changes_;  // by time
};

}  // namespace foveray::simulator
