#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/math.h"

struct GLFWwindow;

namespace foveray::simulator {

/// A window with the pictures of one eye, or of both beside each other, as large as fits.
class PictureWindow {
  public:
    /// Throws Fault(Missing) without a desktop.
    explicit PictureWindow(const std::string& title);
    ~PictureWindow();
    PictureWindow(const PictureWindow&) = delete;
    PictureWindow& operator=(const PictureWindow&) = delete;

    /// Rows from the top, four sRGB bytes a pixel.
    void set_picture(int eye, uvec2 size, const std::uint8_t* bytes);
    /// Waits a moment for the user, then draws what has changed.
    void update();
    bool is_closing() const;

    /// What the user does, since the last update or while it lasts.
    struct Input {
        vec2 dragged{0.0f};  // with the left button, in parts of the height of an eye's picture; y down
        float scrolled = 0.0f;
        vec3 pushed{0.0f};     // W, A, S, D, E, Q: -1, 0 or 1 along x, y, z of the head
        bool reset = false;    // R was pressed
        int pointed_eye = -1;  // with the right button down: the eye whose picture the pointer is in
        vec2 pointed{0.0f};    // where in it: (0, 0) is its top left corner, (1, 1) the bottom right one
    };
    const Input& input() const { return input_; }

  private:
    struct Rectangle {
        vec2 corner{0.0f}, size{0.0f};  // of an eye's picture, in window coordinates
    };
    Rectangle rectangle_of(int eye) const;
    void draw();
    void read_input();

    GLFWwindow* window_ = nullptr;
    std::uint32_t textures_[2]{};
    uvec2 sizes_[2]{};  // of the pictures; 0: none yet
    bool shown_[2]{true, true};
    vec2 pointer_{0.0f};
    float scrolled_ = 0.0f;
    bool reset_ = false, is_stale_ = true;
    Input input_;
};

}  // namespace foveray::simulator
