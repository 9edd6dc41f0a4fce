#pragma once

#include <optional>
#include <string>
#include <sys/types.h>

#include "base/math.h"
#include "xr/simulator/window/picture_window.h"
#include "xr/simulator/window/shared_pictures.h"

namespace foveray::simulator {

/// Turns the user's input into commands for the headset's control socket (docs/simulator.md, "Control").
class HeadControl {
  public:
    explicit HeadControl(pid_t client) : client_(client) {}
    ~HeadControl();
    HeadControl(const HeadControl&) = delete;
    HeadControl& operator=(const HeadControl&) = delete;

    /// `shown`: of the pictures in the window. `seconds` since the last call.
    void apply(const PictureWindow::Input& input, const SharedPictures::Description& shown, float seconds);

  private:
    void send(const std::string& line);

    pid_t client_;
    int socket_ = -1;
    bool refused_ = false;
    std::optional<Pose> stage_from_head_;  // since the user moved it
};

}  // namespace foveray::simulator
