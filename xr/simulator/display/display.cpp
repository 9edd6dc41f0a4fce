#include "xr/simulator/display/display.h"

#include <algorithm>
#include <utility>

#include "xr/simulator/api/verify.h"

namespace foveray::simulator {
namespace {

// Of an eye's picture, pixels a side.
constexpr float max_captured_size = 2048.0f, max_window_size = 1024.0f;

std::array<EyeDisplay, 2> eye_displays(const HeadsetProfile& profile, XrViewConfigurationType type,
                                       float max_size) {
    return {eye_display(profile, type, Eye::Left, max_size),
            eye_display(profile, type, Eye::Right, max_size)};
}

/// Of both eyes' largest pictures.
std::size_t pixel_count(const Instance& instance) {
    std::size_t most = 0;
    for (const XrViewConfigurationType type : instance.view_configurations()) {
        std::size_t pixels = 0;
        for (const EyeDisplay& eye : eye_displays(instance.profile(), type, max_captured_size))
            pixels += std::size_t{eye.size.x} * eye.size.y;
        most = std::max(most, pixels);
    }
    return most;
}

}  // namespace

Display::Display(Instance& instance, VulkanDevice& device) : instance_(instance) {
    const Options& options = instance.options();
    if (options.capture.empty() && !options.window) return;
    if (!device.can_compute()) {
        report(
            "the queue family of the graphics binding takes no compute commands, which captures and the "
            "window need");
        throw Refusal{XR_ERROR_GRAPHICS_DEVICE_INVALID};
    }
    compositor_.emplace(device, options.background);
    if (!options.capture.empty()) capture_.emplace(options, device);
    if (options.window) window_.emplace(*compositor_, pixel_count(instance));
}

std::optional<double> Display::show(const FrameTime& time, XrViewConfigurationType configuration,
                                    XrEnvironmentBlendMode blend_mode, std::vector<Layer> layers) {
    const Script& script = instance_.script();
    if (script.ended(time.index)) return std::nullopt;
    const bool captured = capture_ && capture_->wants(time.index), watched = window_ && window_->is_open();
    if (!captured && !watched) return std::nullopt;

    const Pose head = script.head_at(instance_.clock().session_time(time.display_time)).stage_from_head;
    const SubmittedFrame frame{std::move(layers), blend_mode, time.index, time.display_time, head};
    const HeadsetProfile& profile = instance_.profile();
    if (!captured) {
        window_->show(frame, eye_displays(profile, configuration, max_window_size));
        return std::nullopt;  // it is composed later, if at all
    }
    settle();
    const auto eyes = eye_displays(profile, configuration, max_captured_size);
    compositor_->start(frame, eyes);
    const EyePictures shown = compositor_->finish();
    compositor_->forget();
    capture_->write(time.index, frame.layers, shown);
    if (watched) window_->publish(frame, eyes, shown);
    return compositor_->gpu_milliseconds();
}

void Display::settle() {
    if (window_) window_->settle();
    if (compositor_) compositor_->forget();
}

void Display::release(const Swapchain& swapchain) {
    if (window_) window_->release(swapchain);
}

}  // namespace foveray::simulator
