#pragma once

#include <string>
#include <vector>

#include "app/mirror/picture_layout.h"
#include "render/gpu/vulkan.h"

struct GLFWwindow;

namespace foveray::app {

/// A window on the desktop. Make it before the Vulkan device, which needs its extensions.
class DesktopWindow {
  public:
    /// Throws Fault(Missing) without a desktop, or one that cannot show Vulkan pictures.
    explicit DesktopWindow(const std::string& title);
    ~DesktopWindow();
    DesktopWindow(const DesktopWindow&) = delete;
    DesktopWindow& operator=(const DesktopWindow&) = delete;

    /// For gpu::DeviceOptions.
    std::vector<std::string> instance_extensions() const;
    vk::raii::SurfaceKHR make_surface(const vk::raii::Instance& instance) const;

    GLFWwindow* get() const { return window_; }
    /// The user asked to close it.
    bool is_closing() const;
    /// Returns the keys pressed since the last call, as GLFW_KEY_… codes.
    std::vector<int> poll_events();
    /// Pixels; 0 while minimised.
    uvec2 size() const;

  private:
    GLFWwindow* window_ = nullptr;
    std::vector<int> pressed_keys_;
};

}  // namespace foveray::app
