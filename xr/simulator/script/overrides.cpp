#include "xr/simulator/script/overrides.h"

#include "xr/simulator/placement.h"

namespace foveray::simulator {

void Overrides::set_head(Nanoseconds time, const std::optional<Pose>& stage_from_head) {
    const std::lock_guard lock(mutex_);
    head_.set(time, stage_from_head);
}

void Overrides::set_gaze(Nanoseconds time, const std::optional<GazeSample>& gaze) {
    const std::lock_guard lock(mutex_);
    gaze_.set(time, gaze);
}

void Overrides::set_controller(Nanoseconds time, int hand, std::optional<bool> valid,
                               const Pose& stage_from_grip) {
    const std::lock_guard lock(mutex_);
    Controller controller = controllers_[hand].last().value_or(Controller{});
    controller.valid = valid;
    controller.stage_from_grip = stage_from_grip;
    controllers_[hand].set(time, controller);
}

void Overrides::release_controller(Nanoseconds time, int hand) {
    const std::lock_guard lock(mutex_);
    controllers_[hand].set(time, std::nullopt);
}

void Overrides::set_input(Nanoseconds time, int hand, std::size_t input, float value) {
    const std::lock_guard lock(mutex_);
    Controller controller = controllers_[hand].last().value_or(Controller{});
    controller.inputs[input] = value;
    controllers_[hand].set(time, controller);
}

std::optional<Pose> Overrides::head_at(Nanoseconds time) const {
    const std::lock_guard lock(mutex_);
    return head_.at(time);
}

std::optional<GazeSample> Overrides::gaze_at(Nanoseconds time) const {
    const std::lock_guard lock(mutex_);
    auto gaze = gaze_.at(time);
    if (gaze) gaze->time = time;
    return gaze;
}

bool Overrides::has_controller(int hand) const {
    const std::lock_guard lock(mutex_);
    return controllers_[hand].last().has_value();
}

ControllerState Overrides::controller_at(int hand, Nanoseconds time, const ControllerState& script) const {
    std::optional<Controller> controller;
    {
        const std::lock_guard lock(mutex_);
        controller = controllers_[hand].at(time);
    }
    if (!controller) return script;
    ControllerState state = script;
    if (controller->valid) {
        state.valid = *controller->valid;
        state.stage_from_grip = state.stage_from_aim = controller->stage_from_grip;
    } else if (!script.valid) {
        state.valid = true;
        state.stage_from_grip = state.stage_from_aim = resting_hand(hand);
    }
    const auto& inputs = controller->inputs;
    state.trigger = inputs[0].value_or(state.trigger);
    state.squeeze = inputs[1].value_or(state.squeeze);
    state.thumbstick = {inputs[2].value_or(state.thumbstick.x), inputs[3].value_or(state.thumbstick.y)};
    if (inputs[4]) state.primary_button = *inputs[4] > 0.5f;
    if (inputs[5]) state.secondary_button = *inputs[5] > 0.5f;
    return state;
}

}  // namespace foveray::simulator
