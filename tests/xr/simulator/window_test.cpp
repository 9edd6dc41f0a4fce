// foveray-simulator-window on a virtual display: it shows the eyes' pictures, and comes and goes without the
// client.
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <map>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "tests/xr/simulator/composed.h"
#include "xr/simulator/window/head_control.h"

namespace foveray::simulator_tests {
namespace {

namespace fs = std::filesystem;

bool until(const std::function<bool()>& condition) {
    for (int i = 0; i < 600; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
}

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// An X server without a screen, whose picture can be read.
class VirtualDisplay {
  public:
    VirtualDisplay() {
        const std::string number = folder_ / "number";
        std::vector<std::string> words{"Xvfb",   "-displayfd",   "3",         "-screen", "0", "1280x640x24",
                                       "-fbdir", folder_.path(), "-nolisten", "tcp"};
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, 3, number.c_str(), O_CREAT | O_WRONLY, 0600);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        if (posix_spawnp(&process_, "Xvfb", &actions, nullptr, arguments.data(), environ) != 0) process_ = 0;
        posix_spawn_file_actions_destroy(&actions);
        if (process_) {
            until([&] { return text_of(number).ends_with('\n'); });
            setenv("DISPLAY", (":" + text_of(number).substr(0, text_of(number).find('\n'))).c_str(), 1);
        }
    }
    ~VirtualDisplay() {
        unsetenv("DISPLAY");
        if (!process_) return;
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }
    bool is_there() const { return process_ != 0; }
    /// From the file in X window dump format that Xvfb keeps.
    Rgb pixel_at(std::size_t x, std::size_t y) const {
        const std::string dump = text_of(folder_.path() / "Xvfb_screen0");
        const auto word = [&](std::size_t index) {
            std::size_t value = 0;
            for (std::size_t i = 0; i < 4; ++i)
                value = value << 8 | static_cast<std::uint8_t>(dump[4 * index + i]);
            return value;
        };
        if (dump.size() < 100) return {};
        const std::size_t at = word(0) + 12 * word(19) + y * word(12) + 4 * x;
        const auto byte = [&](std::size_t offset) { return static_cast<std::uint8_t>(dump.at(at + offset)); };
        return {byte(2), byte(1), byte(0)};
    }

  private:
    fakes::TemporaryFolder folder_;
    pid_t process_ = 0;
};

/// Of the window that this process's headset opened; 0: there is none.
pid_t window_process() {
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const std::string command = text_of(entry.path() / "cmdline");
        const std::string ending =
            std::string("foveray-simulator-window\0", 25) + std::to_string(getpid()) + '\0';
        if (command.ends_with(ending)) return static_cast<pid_t>(std::stol(entry.path().filename()));
    }
    return 0;
}

class Window : public Composed {
  protected:
    /// The left eye sees red, the right one green.
    void open(const std::map<std::string, std::string>& variables = {}) {
        auto all = variables;
        all["WINDOW"] = "1";
        all.try_emplace("CAPTURE", "");
        start(all);
        left_ = make_quad(make_plain({250, 0, 0, 255}), 8.0f, 1.0f);
        right_ = make_quad(make_plain({0, 250, 0, 255}), 8.0f, 1.0f);
        left_.eyeVisibility = XR_EYE_VISIBILITY_LEFT;
        right_.eyeVisibility = XR_EYE_VISIBILITY_RIGHT;
    }
    void TearDown() override { client_.reset(); }  // before the display
    bool shows(Rgb left, Rgb right) {
        return until([&] {
            show_opaque(left_, right_);
            return display_.pixel_at(320, 320) == left && display_.pixel_at(960, 320) == right;
        });
    }

    VirtualDisplay display_;
    XrCompositionLayerQuad left_{}, right_{};
};

TEST_F(Window, ShowsBothEyesWhileTheSessionLasts) {
    if (!display_.is_there()) GTEST_SKIP() << "Xvfb is not installed";
    open();
    EXPECT_TRUE(shows({250, 0, 0}, {0, 250, 0}));
    EXPECT_FALSE(fs::exists(captures()));
    EXPECT_NE(window_process(), 0);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), 0) << "the display is the only child";
    client_.reset();
    EXPECT_TRUE(until([] { return window_process() == 0; }));
}

TEST_F(Window, ShowsWhatIsCaptured) {
    if (!display_.is_there()) GTEST_SKIP() << "Xvfb is not installed";
    open({{"CAPTURE", captures()}});
    EXPECT_TRUE(shows({250, 0, 0}, {0, 250, 0}));
    EXPECT_TRUE(fs::exists(captures() / "frame_00000_right.png"));
}

TEST_F(Window, ClosingItLeavesTheClientAlone) {
    if (!display_.is_there()) GTEST_SKIP() << "Xvfb is not installed";
    open();
    EXPECT_TRUE(shows({250, 0, 0}, {0, 250, 0}));
    kill(window_process(), SIGKILL);
    EXPECT_TRUE(until([] { return window_process() == 0; }));
    for (int i = 0; i < 5; ++i) show_opaque(left_, right_);
}

TEST_F(Window, WithoutADesktopTheClientGoesOn) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    open();
    EXPECT_TRUE(until([] { return window_process() == 0; }));
    for (int i = 0; i < 5; ++i) show_opaque(left_, right_);
}

TEST_F(Window, ItsInputMovesHeadAndGaze) {
    start({{"CAPTURE", ""}, {"CONTROL", "1"}}, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO);
    const XrSpace stage = client_->reference_space(XR_REFERENCE_SPACE_TYPE_STAGE),
                  view = client_->reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    const auto head_after_a_frame = [&] {
        return client_->locate(view, stage, client_->empty_frame().predictedDisplayTime).pose;
    };
    simulator::SharedPictures::Description shown;
    shown.fov = {Fov{-pi / 4, pi / 4, pi / 4, -pi / 4}, Fov{-pi / 4, pi / 4, pi / 4, -pi / 4}};
    shown.stage_from_head.position = {0, 1.6f, 0};
    simulator::HeadControl control(getpid());
    simulator::PictureWindow::Input input;
    input.dragged = {-1.0f, 0.0f};  // as far as the picture is high, 90 degrees
    control.apply(input, shown, 0.01f);
    EXPECT_TRUE(
        until([&] { return std::abs(head_after_a_frame().orientation.y - std::sin(pi / 4)) < 1e-5; }));
    input = {};
    input.scrolled = 5.0f;
    input.pushed = {1.0f, 0.0f, 0.0f};  // to its right, which is along -z now
    control.apply(input, shown, 0.5f);
    EXPECT_TRUE(until([&] { return std::abs(head_after_a_frame().position.x + 0.5f) < 1e-5; }));
    EXPECT_NEAR(head_after_a_frame().position.z, -0.5f, 1e-5);

    const auto focus_middle = [&] {
        const XrTime time = client_->empty_frame().predictedDisplayTime;
        const XrFovf fov = client_->locate_views(stage, time, type_, true)[2].fov;
        return (std::tan(fov.angleLeft) + std::tan(fov.angleRight)) / 2;
    };
    input = {};
    input.pointed_eye = 0;
    input.pointed = {0.7f, 0.5f};
    control.apply(input, shown, 0.01f);
    EXPECT_TRUE(until([&] { return std::abs(focus_middle() - 0.4f) < 1e-4; }));
    input = {};
    input.reset = true;
    control.apply(input, shown, 0.01f);
    EXPECT_TRUE(
        until([&] { return head_after_a_frame().orientation.w == 1.0f && std::abs(focus_middle()) < 1e-5; }));
}

}  // namespace
}  // namespace foveray::simulator_tests
