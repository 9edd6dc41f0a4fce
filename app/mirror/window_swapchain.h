#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/mirror/desktop_window.h"
#include "render/gpu/device.h"

namespace foveray::app {

/// The images of a window, made anew when its size changes. They hold sRGB-encoded values; pictures are
/// copied into them, then a render pass draws over.
class WindowSwapchain {
  public:
    /// Throws Fault(Missing) when the device cannot show pictures in the window.
    WindowSwapchain(const gpu::Device& device, const DesktopWindow& window);

    struct Target {
        vk::Image image;  // contents undefined
        vk::Framebuffer framebuffer;
        vk::Semaphore acquired, finished;
        vk::Extent2D extent;
    };
    /// The next image to draw, none while the window is minimised or changes. The work on the one before must
    /// be done.
    std::optional<Target> acquire();
    /// Shows the image once `finished` is signalled.
    void present();

    /// Draws on a colour attachment that keeps its contents, and leaves it ready to be presented.
    vk::RenderPass render_pass() const { return *render_pass_; }
    std::uint32_t image_count() const { return static_cast<std::uint32_t>(images_.size()); }

  private:
    struct ImageParts {
        vk::Image image;
        vk::raii::ImageView view = nullptr;
        vk::raii::Framebuffer framebuffer = nullptr;
        vk::raii::Semaphore finished = nullptr;
    };
    void choose_format();
    void make_render_pass();
    void make_swapchain();

    const gpu::Device& device_;
    const DesktopWindow& window_;
    vk::raii::SurfaceKHR surface_;
    vk::SurfaceFormatKHR format_;
    vk::raii::RenderPass render_pass_ = nullptr;
    vk::raii::Semaphore acquired_;
    vk::raii::SwapchainKHR swapchain_ = nullptr;
    std::vector<ImageParts> images_;
    vk::Extent2D extent_;
    std::uint32_t current_ = 0;
    bool is_stale_ = true;
};

}  // namespace foveray::app
