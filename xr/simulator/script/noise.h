#pragma once

#include <cmath>
#include <cstdint>

#include "base/math.h"

/// Random numbers that are functions of a seed and a place: the same in every run, at any time asked for.
namespace foveray::simulator {

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
inline std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

/// In [0, 1). `channel` tells apart what is drawn at the same place.
inline double uniform(std::uint64_t seed, std::int64_t place, std::uint64_t channel) {
    const std::uint64_t bits = mix(mix(mix(seed) ^ static_cast<std::uint64_t>(place)) ^ channel);
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// Two independent ones of standard deviation 1 (Box and Muller, 1958).
inline vec2 normal_pair(std::uint64_t seed, std::int64_t place, std::uint64_t channel) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(seed, place, 2 * channel)));
    const double angle = 2.0 * 3.14159265358979323846 * uniform(seed, place, 2 * channel + 1);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace foveray::simulator
