#include "xr/simulator/window/picture_window.h"

#include <algorithm>
#include <utility>

#define GLFW_INCLUDE_GLEXT
#include <GLFW/glfw3.h>

#include "base/error.h"

namespace foveray::simulator {
namespace {

constexpr double patience = 0.005;  // seconds that an update waits for the user

PictureWindow& object_of(GLFWwindow* window) {
    return *static_cast<PictureWindow*>(glfwGetWindowUserPointer(window));
}

[[noreturn]] void throw_no_desktop() {
    const char* description = nullptr;
    glfwGetError(&description);
    const std::string why = description ? std::string(": ") + description : std::string();
    glfwTerminate();
    throw_missing("the simulated headset's window", "cannot be opened" + why,
                  "run the program in a desktop session with OpenGL, or without FOVERAY_SIMULATOR_WINDOW");
}

}  // namespace

PictureWindow::PictureWindow(const std::string& title) {
    if (!glfwInit()) throw_no_desktop();
    window_ = glfwCreateWindow(1280, 640, title.c_str(), nullptr, nullptr);
    if (!window_) throw_no_desktop();
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
        if (action != GLFW_PRESS) return;
        PictureWindow& self = object_of(window);
        if (key >= GLFW_KEY_1 && key <= GLFW_KEY_3) {
            self.shown_[0] = key != GLFW_KEY_2;
            self.shown_[1] = key != GLFW_KEY_1;
            self.is_stale_ = true;
        }
        if (key == GLFW_KEY_R) self.reset_ = true;
        if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window, GLFW_TRUE);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) {
        object_of(window).scrolled_ += static_cast<float>(steps);
    });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { object_of(window).is_stale_ = true; });
    glfwSetFramebufferSizeCallback(window_,
                                   [](GLFWwindow* window, int, int) { object_of(window).is_stale_ = true; });
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glGenTextures(2, textures_);
    for (const std::uint32_t texture : textures_) {
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    glEnable(GL_TEXTURE_2D);
}

PictureWindow::~PictureWindow() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

bool PictureWindow::is_closing() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

void PictureWindow::set_picture(int eye, uvec2 size, const std::uint8_t* bytes) {
    is_stale_ = true;
    const auto width = static_cast<GLsizei>(size.x), height = static_cast<GLsizei>(size.y);
    glBindTexture(GL_TEXTURE_2D, textures_[eye]);
    if (size != sizes_[eye]) {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
        sizes_[eye] = size;
    } else {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
    }
}

PictureWindow::Rectangle PictureWindow::rectangle_of(int eye) const {
    int width = 0, height = 0;
    glfwGetWindowSize(window_, &width, &height);
    const float count = shown_[0] && shown_[1] ? 2.0f : 1.0f;
    const vec2 room(static_cast<float>(width) / count, height), size(sizes_[eye]);
    Rectangle result;
    result.size = size * std::min(room.x / size.x, room.y / size.y);
    // Both eyes meet in the middle.
    result.corner.x = count == 1.0f ? (room.x - result.size.x) / 2
                      : eye == 0    ? room.x - result.size.x
                                    : room.x;
    result.corner.y = (room.y - result.size.y) / 2;
    return result;
}

void PictureWindow::draw() {
    int width = 0, height = 0, pixel_width = 0, pixel_height = 0;
    glfwGetWindowSize(window_, &width, &height);
    glfwGetFramebufferSize(window_, &pixel_width, &pixel_height);
    glViewport(0, 0, pixel_width, pixel_height);
    glClear(GL_COLOR_BUFFER_BIT);
    glLoadIdentity();
    glOrtho(0, width, height, 0, -1, 1);
    for (int eye = 0; eye < 2; ++eye) {
        if (!shown_[eye] || sizes_[eye].x == 0) continue;
        const auto [corner, size] = rectangle_of(eye);
        glBindTexture(GL_TEXTURE_2D, textures_[eye]);
        glBegin(GL_TRIANGLE_STRIP);
        for (const vec2 part : {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(1, 1)}) {
            glTexCoord2f(part.x, part.y);
            glVertex2f(corner.x + part.x * size.x, corner.y + part.y * size.y);
        }
        glEnd();
    }
    glfwSwapBuffers(window_);
}

void PictureWindow::read_input() {
    input_ = {};
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window_, &x, &y);
    const vec2 pointer(x, y), moved = pointer - pointer_;
    pointer_ = pointer;
    const auto is_down = [&](int key) { return glfwGetKey(window_, key) == GLFW_PRESS ? 1.0f : 0.0f; };
    input_.pushed = vec3(is_down(GLFW_KEY_D) - is_down(GLFW_KEY_A), is_down(GLFW_KEY_E) - is_down(GLFW_KEY_Q),
                         is_down(GLFW_KEY_S) - is_down(GLFW_KEY_W));
    input_.scrolled = std::exchange(scrolled_, 0.0f);
    input_.reset = std::exchange(reset_, false);
    for (int eye = 0; eye < 2; ++eye) {
        if (!shown_[eye] || sizes_[eye].x == 0) continue;
        const auto [corner, size] = rectangle_of(eye);
        if (glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
            input_.dragged = moved / size.y;
        const vec2 place = (pointer - corner) / size;
        const bool inside = place.x >= 0.0f && place.y >= 0.0f && place.x <= 1.0f && place.y <= 1.0f;
        if (inside && glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS) {
            input_.pointed_eye = eye;
            input_.pointed = place;
        }
    }
}

void PictureWindow::update() {
    glfwWaitEventsTimeout(patience);
    read_input();
    if (std::exchange(is_stale_, false)) draw();
}

}  // namespace foveray::simulator
