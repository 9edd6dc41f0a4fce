#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

namespace foveray::fuzz {

/// Choices that a seed repeats.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    std::uint64_t bits() { return engine_(); }
    /// Below `count`, which is at least 1.
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits() % count); }
    /// True in `percent` of all calls.
    bool chance(int percent) { return static_cast<int>(below(100)) < percent; }
    template <typename T>
    T pick(std::initializer_list<T> list) {
        return *(list.begin() + below(list.size()));
    }
    template <typename T>
    const T& pick(const std::vector<T>& list) {
        return list[below(list.size())];
    }
    /// Mostly between -1 and 1, sometimes what arithmetic fears.
    float number() {
        if (chance(90)) return static_cast<float>(below(2001)) / 1000.0f - 1.0f;
        using limits = std::numeric_limits<float>;
        return pick({0.0f, -0.0f, 1e30f, -1e30f, limits::infinity(), -limits::infinity(), limits::quiet_NaN(),
                     limits::max(), limits::denorm_min()});
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace foveray::fuzz
