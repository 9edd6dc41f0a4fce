#include "render/ray_budget.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fakes/random.h"

namespace foveray::render {
namespace {

constexpr double share = 0.8;
constexpr int latency = 2;  // frames from a choice to its frame's time on the GPU

/// A display and a GPU on which a frame at full scale takes `load` budgets at the medium level, and a level
/// up doubles it.
struct Display {
    double hz = 90.0;
    std::function<double(double seconds)> load = [](double) { return 0.5; };
    std::function<float(double seconds)> head_speed = [](double) { return 0.0f; };
    float noise = 0.0f;  // of a frame's time: at most this part more or less
    double level_factor = 2.0;
    bool chooses_level = false;
    float least_scale = 0.5f;
    std::uint32_t seed = 7;

    struct FrameResult {
        double seconds, share_used;  // of the budget
        RayChoice choice;
    };

    std::vector<FrameResult> run(double seconds) const {
        RayBudget budget;
        fakes::Random random(seed);
        const double budget_ms = share * 1e3 / hz;
        std::vector<FrameResult> frames;
        for (int i = 0; i < static_cast<int>(seconds * hz); ++i) {
            const double now = i / hz;
            RayBudgetInput input;
            if (i >= latency) {
                const FrameResult& done = frames[i - latency];
                input.finished = {done.share_used * budget_ms, done.choice};
            }
            input.budget_ms = budget_ms;
            input.least_scale = least_scale;
            input.head_speed = head_speed(now);
            input.seconds = i == 0 ? 0.0 : 1.0 / hz;
            input.chooses_level = chooses_level;
            const RayChoice choice = budget.update(input);
            const double scale = static_cast<double>(choice.scale);
            const double level = std::pow(level_factor, static_cast<int>(choice.level) - 1);
            const double noisy = 1.0 + static_cast<double>(random.in(-noise, noise));
            frames.push_back({now, load(now) * level * scale * scale * noisy, choice});
        }
        return frames;
    }
};

std::function<double(double)> step_at(double seconds, double before, double after) {
    return [=](double now) { return now < seconds ? before : after; };
}

std::size_t changes(const std::vector<Display::FrameResult>& frames, double from, auto what) {
    std::size_t count = 0;
    for (std::size_t i = 1; i < frames.size(); ++i)
        count += frames[i].seconds >= from && what(frames[i].choice) != what(frames[i - 1].choice);
    return count;
}

/// How often a scale that rose falls, or one that fell rises.
std::size_t turns(const std::vector<Display::FrameResult>& frames, double from) {
    std::size_t count = 0;
    float direction = 0.0f;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        if (frames[i].seconds < from) continue;
        const float change = frames[i].choice.scale - frames[i - 1].choice.scale;
        if (change == 0.0f) continue;
        count += change * direction < 0.0f;
        direction = change;
    }
    return count;
}

const auto scale_of = [](const RayChoice& choice) { return choice.scale; };
const auto level_of = [](const RayChoice& choice) { return choice.level; };

TEST(RayBudget, FullScaleWhileItFits) {
    for (const auto& frame : Display{}.run(2.0)) EXPECT_EQ(frame.choice.scale, 1.0f);
}

TEST(RayBudget, AnOverloadIsMetWithinAFewFrames) {
    for (const double hz : {60.0, 90.0}) {
        Display display{.hz = hz, .load = step_at(1.0, 0.6, 2.0)};
        for (const auto& frame : display.run(3.0)) {
            if (frame.seconds >= 1.0 + 6.5 / hz) {
                EXPECT_LE(frame.share_used, 1.03) << frame.seconds;
            }
        }
    }
}

TEST(RayBudget, NeverUnderTheFloor) {
    for (const float least : {0.5f, 0.55f, 0.75f, 1.0f}) {
        Display display{.load = [](double) { return 50.0; },
                        .head_speed = [](double) { return 10.0f; },
                        .chooses_level = true,
                        .least_scale = least};
        const auto frames = display.run(2.0);
        for (const auto& frame : frames) {
            EXPECT_GE(frame.choice.scale, least);
            EXPECT_LE(frame.choice.scale, 1.0f);
        }
        EXPECT_LT(frames.back().choice.scale, least + RayBudget::step);
    }
}

TEST(RayBudget, RecoversWithinHalfASecondOfLoadGoingAway) {
    for (const double hz : {60.0, 90.0}) {
        for (const double after : {0.3, 0.9, 1.2, 1.5}) {
            for (const float noise : {0.0f, 0.05f}) {
                Display display{.hz = hz, .load = step_at(1.0, 6.0, after), .noise = noise};
                const auto frames = display.run(3.0);
                const double sustainable = std::min(std::sqrt(1.0 / after), 1.0);
                const float finest =
                    std::floor(static_cast<float>(sustainable) / RayBudget::step) * RayBudget::step;
                for (const auto& frame : frames) {
                    if (frame.seconds >= 1.5) {
                        EXPECT_GE(frame.choice.scale, finest - RayBudget::step)
                            << hz << " Hz, load " << after << ", " << frame.seconds << " s";
                    }
                }
            }
        }
    }
}

TEST(RayBudget, NoPumpingUnderANoisyConstantLoad) {
    for (const double hz : {60.0, 90.0}) {
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            for (double load = 0.5; load < 4.5; load += 0.05) {
                Display display{.hz = hz, .load = [=](double) { return load; }, .noise = 0.1f, .seed = seed};
                const auto frames = display.run(60.0);
                EXPECT_EQ(turns(frames, 0.0), 0u) << hz << " Hz, load " << load;
                // Where noise reaches the edge of what fits, one last step down.
                EXPECT_LE(changes(frames, 1.0, scale_of), 1u) << hz << " Hz, load " << load;
            }
        }
    }
}

TEST(RayBudget, OneSlowFrameChangesNothing) {
    Display display{.load = [](double now) { return std::abs(now - 1.0) < 0.004 ? 5.0 : 0.9; }};
    EXPECT_EQ(changes(display.run(2.0), 0.0, scale_of), 0u);
}

TEST(RayBudget, RisesAStepAtATime) {
    Display display{.load = step_at(1.0, 6.0, 0.2)};
    const auto frames = display.run(3.0);
    double last_rise = 0.0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const float rise = frames[i].choice.scale - frames[i - 1].choice.scale;
        EXPECT_LE(rise, RayBudget::step);
        if (rise <= 0.0f) continue;
        EXPECT_GE(frames[i].seconds - last_rise, 0.03);
        last_rise = frames[i].seconds;
    }
    EXPECT_EQ(frames.back().choice.scale, 1.0f);
}

TEST(RayBudget, ScalesAreMultiplesOfTheStep) {
    Display display{.load = [](double now) { return 1.5 + std::sin(7.0 * now); }, .noise = 0.1f};
    for (const auto& frame : display.run(5.0)) {
        const float steps = frame.choice.scale / RayBudget::step;
        EXPECT_EQ(steps, std::round(steps));
    }
}

TEST(RayBudget, ATurningHeadGetsALowerScaleAndAStillOneItsOwnBack) {
    Display display{.head_speed = [](double now) { return now < 1.0 || now > 2.0 ? 0.0f : 3.0f; }};
    float least = 1.0f;
    for (const auto& frame : display.run(3.0)) {
        least = std::min(least, frame.choice.scale);
        if (frame.seconds >= 2.6) {
            EXPECT_EQ(frame.choice.scale, 1.0f) << frame.seconds;
        }
    }
    EXPECT_FLOAT_EQ(least, 0.75f);
}

TEST(RayBudget, AnUnsteadyTurnDoesNotPump) {
    for (float mean = 0.4f; mean < 3.0f; mean += 0.1f) {
        Display display{
            .head_speed = [=](double now) { return mean + 0.3f * static_cast<float>(std::sin(20.0 * now)); },
            .noise = 0.05f};
        EXPECT_EQ(turns(display.run(10.0), 0.0), 0u) << mean;
    }
}

TEST(RayBudget, AStillHeadWithTimeLeftGetsTheBestLevel) {
    Display display{.load = [](double) { return 0.2; }, .chooses_level = true};
    const auto frames = display.run(6.0);
    EXPECT_EQ(frames.front().choice.level, QualityLevel::Medium);
    EXPECT_EQ(frames.back().choice.level, QualityLevel::Best);
    EXPECT_EQ(frames.back().choice.scale, 1.0f);
    EXPECT_EQ(changes(frames, 0.0, level_of), 2u);
}

TEST(RayBudget, AMovingHeadGetsNoMoreThanTheMediumLevel) {
    Display display{.load = [](double) { return 0.1; },
                    .head_speed = [](double now) { return now < 5.0 ? 0.0f : 1.5f; },
                    .chooses_level = true};
    const auto frames = display.run(8.0);
    EXPECT_EQ(frames[4 * 90].choice.level, QualityLevel::Best);
    EXPECT_EQ(frames.back().choice.level, QualityLevel::Medium);
}

TEST(RayBudget, LevelsFallBeforeTheScaleDoesForLong) {
    Display display{.load = step_at(6.0, 0.2, 0.85), .chooses_level = true};
    const auto frames = display.run(10.0);
    EXPECT_EQ(frames.back().choice.level, QualityLevel::Medium);
    EXPECT_EQ(frames.back().choice.scale, 1.0f);

    display.load = step_at(2.0, 0.85, 3.0);
    const auto heavier = display.run(10.0);
    EXPECT_EQ(heavier.back().choice.level, QualityLevel::Low);
    EXPECT_GE(heavier.back().choice.scale, 0.75f);
}

TEST(RayBudget, ALevelThatDoesNotFitIsNotTriedAgainAndAgain) {
    for (double load = 0.1; load < 4.0; load += 0.1) {
        for (const double factor : {1.3, 2.0, 3.0, 5.0}) {
            Display display{.load = [=](double) { return load; },
                            .noise = 0.05f,
                            .level_factor = factor,
                            .chooses_level = true};
            const auto frames = display.run(60.0);
            EXPECT_LE(changes(frames, 0.0, level_of), 4u) << load << " " << factor;
            EXPECT_EQ(turns(frames, 10.0), 0u) << load << " " << factor;
            EXPECT_LE(changes(frames, 10.0, scale_of), 1u) << load << " " << factor;
        }
    }
}

TEST(RayBudget, TheSameInputsGiveTheSameChoices) {
    Display display{.load = [](double now) { return 1.5 + std::sin(3.0 * now); },
                    .head_speed = [](double now) { return static_cast<float>(1.0 + std::cos(now)); },
                    .noise = 0.1f,
                    .chooses_level = true};
    const auto first = display.run(10.0), second = display.run(10.0);
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].choice, second[i].choice);
}

}  // namespace
}  // namespace foveray::render
