#pragma once

#include <optional>
#include <vector>

#include "xr/simulator/display/capture.h"
#include "xr/simulator/display/compositor.h"
#include "xr/simulator/display/window_feed.h"
#include "xr/simulator/frame_clock.h"
#include "xr/simulator/instance.h"

namespace foveray::simulator {

/// What becomes of a session's frames: they are captured, shown in a window, or only counted.
class Display {
  public:
    /// Refuses with XR_ERROR_GRAPHICS_DEVICE_INVALID when frames shall be captured or shown and the client's
    /// queue cannot compose them. Throws Fault(BadInput) when the background cannot be read.
    Display(Instance& instance, VulkanDevice& device);

    /// One caller at a time, while the client synchronises its queue. The GPU's milliseconds for the
    /// composition where they are known by then. Throws Fault when a file cannot be written.
    std::optional<double> show(const FrameTime& time, XrViewConfigurationType configuration,
                               XrEnvironmentBlendMode blend_mode, std::vector<Layer> layers);
    /// Waits until nothing is under way, and lets go of what was shown.
    void settle();
    /// Waits until the GPU does not read the swapchain. From any thread.
    void release(const Swapchain& swapchain);

  private:
    Instance& instance_;
    std::optional<Compositor> compositor_;  // when something is captured or shown in a window
    std::optional<Capture> capture_;
    std::optional<WindowFeed> window_;
};

}  // namespace foveray::simulator
