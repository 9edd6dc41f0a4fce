#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace foveray::render {

/// Which of the structures whose geometry changes are rebuilt in a frame, and which only refitted: refitting
/// is cheap, and the boxes of what was refitted often overlap more and more, which rays pay for. Decided from
/// counts alone, so that replays repeat it.
///
/// A build of n primitives is taken to cost n (build_cost + log2 n), a refit n, and every refit since the
/// last build as much again in each frame's rays: a structure is due when what its refits have cost
/// exceeds what a build would, as one buys skis when as much has been spent on renting them.
class RebuildPlan {
  public:
    static constexpr std::uint32_t always_rebuilt = 64;  // primitives: to refit so few takes as long
    static constexpr std::uint32_t build_cost = 8;
    /// Primitives rebuilt in a frame, so that large structures take turns: those most overdue first, and at
    /// least one.
    static constexpr std::uint64_t frame_budget = 1u << 18;

    /// `primitive_counts`: by structure. What is built at the start is due at its first change.
    explicit RebuildPlan(std::vector<std::uint32_t> primitive_counts);

    /// Once a frame. `changed`: by structure. The result too; true: rebuild, false: refit, if it has changed.
    std::vector<bool> choose(std::span<const std::uint8_t> changed);

    /// Refits that a structure of so many primitives goes through between builds, when it is not kept
    /// waiting.
    static std::uint32_t refits_between_builds(std::uint32_t primitives);

  private:
    std::vector<std::uint32_t> primitives_, refits_;  // by structure; refits: since the last build
};

}  // namespace foveray::render
