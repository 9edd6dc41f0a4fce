#pragma once

#include <array>
#include <mutex>
#include <optional>
#include <string_view>

#include "base/frame.h"
#include "base/gaze.h"
#include "xr/simulator/script/timeline.h"

namespace foveray::simulator {

/// What commands put in the place of the script, by session time. Safe to use from any thread.
class Overrides {
  public:
    struct Controller {
        std::optional<bool> valid;                   // nothing: the script's
        Pose stage_from_grip;                        // while it is valid
        std::array<std::optional<float>, 6> inputs;  // by input_names
    };
    /// The columns of controllers.csv.
    static constexpr std::array<std::string_view, 6> input_names = {"trigger", "squeeze", "stick_x",
                                                                    "stick_y", "primary", "secondary"};

    /// Nothing: the script's again.
    void set_head(Nanoseconds time, const std::optional<Pose>& stage_from_head);
    void set_gaze(Nanoseconds time, const std::optional<GazeSample>& gaze);
    void set_controller(Nanoseconds time, int hand, std::optional<bool> valid, const Pose& stage_from_grip);
    void release_controller(Nanoseconds time, int hand);
    void set_input(Nanoseconds time, int hand, std::size_t input, float value);

    std::optional<Pose> head_at(Nanoseconds time) const;
    std::optional<GazeSample> gaze_at(Nanoseconds time) const;
    /// There was a command for that hand's controller.
    bool has_controller(int hand) const;
    /// `script` with what commands changed. A hand without one holds it before the chest.
    ControllerState controller_at(int hand, Nanoseconds time, const ControllerState& script) const;

  private:
    mutable std::mutex mutex_;
    Timeline<std::optional<Pose>> head_;
    Timeline<std::optional<GazeSample>> gaze_;
    std::array<Timeline<std::optional<Controller>>, 2> controllers_;
};

}  // namespace foveray::simulator
