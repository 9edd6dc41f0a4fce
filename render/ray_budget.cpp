#include "render/ray_budget.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace foveray::render {
namespace {

// Cost
constexpr double smoothing = 0.05;         // seconds
constexpr double overload = 1.25;          // a cost that grew by this is believed at once
constexpr std::size_t settled_frames = 8;  // of a level before its cost is compared with the last one's

// Scale
constexpr double far_over = 0.94, over = 0.985;      // sustainable part of a scale that is too large
constexpr double room = 1.06;                        // the next step must fit so many times
constexpr double wait_time = 0.1;                    // seconds that a reason for a step must last
constexpr double step_time = 0.04;                   // seconds from a step to the next one
constexpr float slow_turn = 0.5f, fast_turn = 2.5f;  // radians a second
constexpr float turning_scale = 0.75f;               // enough from fast_turn on
constexpr double turn_smoothing = 0.1;               // seconds

// Level
constexpr float still_head = 0.1f, moving_head = 1.0f;                                    // radians a second
constexpr double still_time = 0.5, short_time = 0.25, level_time = 0.5, rise_time = 1.0;  // seconds
constexpr double reserve = 1.06;  // of the sustainable scale above 1 that a better level must leave
constexpr double scale_short = 0.97, medium_short = 0.75, medium_fits = 0.9;  // sustainable scales

constexpr double longest_frame = 0.1;  // seconds; after a pause

float floor_to_step(double scale) {
    return static_cast<float>(std::floor(scale / RayBudget::step)) * RayBudget::step;
}

double share_after(double seconds, double time) { return 1.0 - std::exp(-seconds / time); }

double median(std::array<double, 3> values) {
    std::ranges::sort(values);
    return values[1];
}

/// The scale that is worth tracing while the head turns.
float useful_scale(float head_speed) {
    const float turn = std::clamp((head_speed - slow_turn) / (fast_turn - slow_turn), 0.0f, 1.0f);
    return 1.0f + turn * (turning_scale - 1.0f);
}

QualityLevel next(QualityLevel level, int steps) {
    return static_cast<QualityLevel>(static_cast<int>(level) + steps);
}

}  // namespace

RayChoice RayBudget::update(const RayBudgetInput& input) {
    assert(input.budget_ms > 0.0 && input.least_scale > 0.0f && input.least_scale <= 1.0f);
    RayBudgetInput now = input;
    now.seconds = std::clamp(input.seconds, 0.0, longest_frame);
    head_speed_ +=
        static_cast<float>(share_after(now.seconds, turn_smoothing)) * (input.head_speed - head_speed_);
    if (input.finished && input.finished->choice.level == choice_.level)
        observe(*input.finished, now.seconds);
    sustainable_ = cost_ > 0.0 ? std::sqrt(input.budget_ms / cost_) : 1.0;
    if (input.chooses_level) choose_level(now);
    choose_scale(now);
    return choice_;
}

void RayBudget::observe(const RayBudgetInput::Finished& finished, double seconds) {
    const double scale = static_cast<double>(finished.choice.scale);
    newest_costs_[observed_++ % newest_costs_.size()] = finished.gpu_ms / (scale * scale);
    if (observed_ < newest_costs_.size()) return;
    const double cost = median(newest_costs_);
    const bool believed = observed_ == newest_costs_.size() || cost > overload * cost_;
    cost_ += (believed ? 1.0 : share_after(seconds, smoothing)) * (cost - cost_);
    if (observed_ == settled_frames && left_) {
        const QualityLevel lower = std::min(left_->level, choice_.level);
        const double ratio = left_->level == lower ? cost_ / left_cost_ : left_cost_ / cost_;
        step_cost(lower) = std::clamp(ratio, 1.0, 8.0);
        left_.reset();
    }
}

void RayBudget::choose_scale(const RayBudgetInput& input) {
    const float least = std::ceil(input.least_scale / step) * step;
    const double useful = static_cast<double>(std::max(useful_scale(head_speed_), least));
    const double scale = static_cast<double>(choice_.scale);
    const bool exceeds = sustainable_ < over * scale;
    const bool turns = useful <= scale - step;
    const bool fits = std::min(sustainable_ / room, useful) >= scale + step;
    waited_ = exceeds || turns || fits ? waited_ + input.seconds : 0.0;
    if (sustainable_ < far_over * scale || (exceeds && waited_ >= wait_time)) {
        choice_.scale = floor_to_step(sustainable_);
        waited_ = 0.0;
    } else if (waited_ >= wait_time) {
        choice_.scale += turns ? -step : step;
        waited_ -= step_time;
    }
    choice_.scale = std::clamp(choice_.scale, least, 1.0f);
}

void RayBudget::choose_level(const RayBudgetInput& input) {
    const QualityLevel level = choice_.level;
    const bool fine = level > QualityLevel::Medium;
    const auto lasts = [&](double& time, bool condition) { time = condition ? time + input.seconds : 0.0; };
    since_level_ += input.seconds;
    lasts(still_for_, head_speed_ < still_head);
    lasts(short_for_, level > QualityLevel::Low && sustainable_ < (fine ? scale_short : medium_short));
    if (observed_ < settled_frames || since_level_ < level_time) return;

    if (short_for_ >= short_time || (fine && head_speed_ > moving_head)) {
        go_to(next(level, -1));
    } else if (level < QualityLevel::Best && since_level_ >= rise_time) {
        const double then = sustainable_ / std::sqrt(step_cost(level));
        if (level == QualityLevel::Low ? then >= medium_fits : still_for_ >= still_time && then >= reserve)
            go_to(next(level, 1));
    }
}

void RayBudget::go_to(QualityLevel level) {
    const bool up = level > choice_.level;
    left_ = choice_;
    left_cost_ = cost_;
    const double ratio = step_cost(std::min(level, choice_.level));
    cost_ = up ? cost_ * ratio : cost_ / ratio;
    sustainable_ = up ? sustainable_ / std::sqrt(ratio) : sustainable_ * std::sqrt(ratio);
    choice_.level = level;
    observed_ = 0;
    since_level_ = short_for_ = 0.0;
}

}  // namespace foveray::render
