#define GLFW_INCLUDE_VULKAN
#include "app/mirror/desktop_window.h"

#include <utility>

#include <GLFW/glfw3.h>

#include "base/error.h"

namespace foveray::app {
namespace {

[[noreturn]] void throw_no_desktop() {
    const char* description = nullptr;
    glfwGetError(&description);
    const std::string why = description ? std::string(": ") + description : std::string();
    glfwTerminate();
    throw_missing("--mirror", "no window can be opened" + why,
                  "run it in a desktop session, or without --mirror");
}

}  // namespace

DesktopWindow::DesktopWindow(const std::string& title) {
    if (!glfwInit() || !glfwVulkanSupported()) throw_no_desktop();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(1280, 800, title.c_str(), nullptr, nullptr);
    if (!window_) throw_no_desktop();
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
        if (action != GLFW_PRESS) return;
        static_cast<DesktopWindow*>(glfwGetWindowUserPointer(window))->pressed_keys_.push_back(key);
    });
}

DesktopWindow::~DesktopWindow() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::vector<std::string> DesktopWindow::instance_extensions() const {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return {names, names + count};
}

vk::raii::SurfaceKHR DesktopWindow::make_surface(const vk::raii::Instance& instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(*instance, window_, nullptr, &surface) != VK_SUCCESS) {
        throw_missing("--mirror", "the window takes no Vulkan pictures", "run it without --mirror");
    }
    return {instance, surface};
}

bool DesktopWindow::is_closing() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

std::vector<int> DesktopWindow::poll_events() {
    glfwPollEvents();
    return std::exchange(pressed_keys_, {});
}

uvec2 DesktopWindow::size() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {width, height};
}

}  // namespace foveray::app
