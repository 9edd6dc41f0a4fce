#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/quality.h"

namespace foveray::render {

/// How finely to trace.
struct RayChoice {
    float scale = 1.0f;  // of both axes of the polar image
    QualityLevel level = QualityLevel::Medium;

    bool operator==(const RayChoice&) const = default;
};

struct RayBudgetInput {
    struct Finished {
        double gpu_ms = 0.0;
        RayChoice choice;  // that it was traced with
    };
    std::optional<Finished> finished;  // a frame that was not given before
    double budget_ms = 0.0;            // what a frame may take, above 0
    float least_scale = 0.5f;          // at most 1
    float head_speed = 0.0f;           // radians a second
    double seconds = 0.0;              // of session time since the last call
    bool chooses_level = false;        // else it stays as it is
};

/// Dynamic resolution (HERR section 3.2): follows what frames cost on the GPU and how fast the head turns. A
/// frame's cost is taken to be proportional to its rays, the square of the scale. Plain arithmetic on its
/// inputs: the same inputs give the same choices.
///
/// Scales are multiples of `step`, so that the pattern of samples does not breathe. Far over the budget they
/// fall at once, as far as it asks, a little over it after a while; they rise a step at a time, after there
/// was room for the next step and a margin for a while. One slow frame changes nothing. A turning head sees
/// fewer samples and gets a lower scale.
///
/// The level goes up while the head is still and the full scale fits with a reserve, and down when it does
/// not fit, before the scale does for long. What the next level costs is learnt when it was tried, so that
/// one which does not fit is not tried again and again.
class RayBudget {
  public:
    static constexpr float step = 1.0f / 16.0f;

    RayChoice update(const RayBudgetInput& input);

  private:
    static constexpr std::size_t level_count = 4;

    void observe(const RayBudgetInput::Finished& finished, double seconds);
    void choose_scale(const RayBudgetInput& input);
    void choose_level(const RayBudgetInput& input);
    void go_to(QualityLevel level);
    double& step_cost(QualityLevel lower) { return step_costs_[static_cast<std::size_t>(lower)]; }

    RayChoice choice_;
    double sustainable_ = 1.0;  // scale that the budget allows; may be above 1
    float head_speed_ = 0.0f;   // smoothed
    double waited_ = 0.0;       // seconds for which there was a reason for another scale

    // Milliseconds of a frame at full scale and the present level, smoothed; 0: not known yet.
    double cost_ = 0.0;
    std::array<double, 3> newest_costs_{};  // as observed, a ring
    std::size_t observed_ = 0;              // since the level changed

    // Times in seconds that have lasted so far.
    double since_level_ = 0.0, still_for_ = 0.0, short_for_ = 0.0;
    std::optional<RayChoice> left_;  // the level before the present one, until their costs are compared
    double left_cost_ = 0.0;
    std::array<double, level_count - 1> step_costs_{2.0, 2.0, 2.0};  // of the level above, by a level's own
};

}  // namespace foveray::render
