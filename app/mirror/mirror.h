#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/mirror/desktop_window.h"
#include "app/mirror/panel.h"
#include "app/mirror/picture_copy.h"
#include "app/mirror/window_swapchain.h"
#include "app/report/run_report.h"
#include "base/settings.h"
#include "base/view.h"

namespace foveray::app {

/// Shows on the desktop what the wearer of the headset sees, with times and settings beside it.
class Mirror {
  public:
    /// A view's finished picture: tightly packed sRGB-encoded premultiplied RGBA8, written by compute shaders
    /// on the device's queue.
    struct Picture {
        View view;
        vk::Buffer color;
        vk::DeviceSize offset = 0;
    };

    /// The device needs window.instance_extensions() and presentation. Throws Fault(Missing) when it cannot
    /// show pictures in the window. One at a time in a process.
    Mirror(const gpu::Device& device, DesktopWindow& window);
    ~Mirror();
    Mirror(const Mirror&) = delete;
    Mirror& operator=(const Mirror&) = delete;

    /// Once a frame, after the work that makes the pictures was submitted. A focus view lies over its eye's
    /// context view. The user may change `settings`. Later work on the queue may overwrite the pictures.
    void show(std::span<const Picture> pictures, const FrameMetrics& metrics, bool has_eye_tracking,
              Settings& settings);

    /// The last place of the mouse on the picture, in 0..1 over the context view from the top left.
    std::optional<vec2> pointer() const { return pointer_; }
    /// The user closed the window.
    bool wants_close() const { return state_.wants_close || window_.is_closing(); }

  private:
    void init_imgui();
    /// Returns where the picture goes, in the window's pixels.
    Rect draw_interface(const Picture* context, const FrameMetrics& metrics, bool has_eye_tracking,
                        Settings& settings);
    void record(const gpu::Commands& cmd, std::span<const Picture> pictures,
                const WindowSwapchain::Target& target, const Rect& place);

    const gpu::Device& device_;
    DesktopWindow& window_;
    WindowSwapchain swapchain_;
    vk::raii::DescriptorPool descriptors_ = nullptr;
    vk::raii::CommandPool pool_ = nullptr;
    vk::raii::CommandBuffer cmd_ = nullptr;
    vk::raii::Fence done_ = nullptr;
    std::array<PictureCopy, 2> copies_;  // context, focus
    TimeHistory history_;
    MirrorState state_;
    std::optional<vec2> pointer_;
};

}  // namespace foveray::app
