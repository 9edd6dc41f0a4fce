#pragma once

#include <cstdint>

namespace foveray {

/// A point in time or a span, in nanoseconds, with the meaning of XrTime: comparable only within one source.
using Nanoseconds = std::int64_t;

constexpr Nanoseconds nanoseconds_per_second = 1'000'000'000;
constexpr Nanoseconds nanoseconds_per_millisecond = 1'000'000;

constexpr double to_seconds(Nanoseconds t) { return static_cast<double>(t) * 1e-9; }
constexpr Nanoseconds from_seconds(double s) {
    return static_cast<Nanoseconds>(s * 1e9 + (s < 0 ? -0.5 : 0.5));
}

}  // namespace foveray
