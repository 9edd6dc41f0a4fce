#pragma once

#include "base/math.h"

namespace foveray::scene {

/// Where probes of indirect light stand: evenly in a box in world space, the outermost ones a quarter of the
/// spacing off its sides, because a box is mostly a room, and light near a wall is best known near it.
struct ProbeGrid {
    static constexpr std::uint32_t most = 16384;  // probes; each takes about 7 kB on the GPU

    uvec3 counts{16, 8, 16};  // along x, y and z
    vec3 min{0.0f}, max{0.0f};

    bool operator==(const ProbeGrid&) const = default;
};

}  // namespace foveray::scene
