#include "xr/simulator/window/head_control.h"

#include <cstdio>
#include <sys/socket.h>
#include <unistd.h>

#include "xr/simulator/control/control_path.h"

namespace foveray::simulator {
namespace {

constexpr float metres_per_second = 1.0f, metres_per_scroll = 0.1f;

template <typename... Numbers>
std::string command(const char* format, Numbers... numbers) {
    char text[200];
    std::snprintf(text, sizeof text, format, static_cast<double>(numbers)...);
    return text;
}

bool has_moved(const PictureWindow::Input& input) {
    return input.dragged != vec2(0.0f) || input.scrolled != 0.0f || input.pushed != vec3(0.0f);
}

/// Round the vertical of the stage and the ears of the head, as a neck turns it.
Pose moved(const Pose& head, const PictureWindow::Input& input, const Fov& fov, float seconds) {
    const float angle_per_height = fov.up - fov.down;
    const quat heading = glm::angleAxis(-input.dragged.x * angle_per_height, vec3(0, 1, 0));
    const quat pitch = glm::angleAxis(-input.dragged.y * angle_per_height, vec3(1, 0, 0));
    Pose result;
    result.orientation = glm::normalize(heading * head.orientation * pitch);
    const vec3 step =
        metres_per_second * seconds * input.pushed - vec3(0, 0, metres_per_scroll * input.scrolled);
    result.position = head.position + result.orientation * step;
    return result;
}

}  // namespace

HeadControl::~HeadControl() {
    if (socket_ >= 0) close(socket_);
}

void HeadControl::apply(const PictureWindow::Input& input, const SharedPictures::Description& shown,
                        float seconds) {
    if (input.reset) {
        stage_from_head_.reset();
        send("head script");
        send("gaze script");
    }
    if (has_moved(input)) {
        stage_from_head_ =
            moved(stage_from_head_.value_or(shown.stage_from_head), input, shown.fov[0], seconds);
        const auto& [q, p] = *stage_from_head_;
        send(command("head %.6f %.6f %.6f %.7f %.7f %.7f %.7f", p.x, p.y, p.z, q.x, q.y, q.z, q.w));
    }
    if (input.pointed_eye >= 0) {
        const vec3 d = glm::normalize(
            direction_at(shown.fov[static_cast<std::size_t>(input.pointed_eye)], input.pointed));
        send(command("gaze %.6f %.6f %.6f", d.x, d.y, d.z));
    }
}

void HeadControl::send(const std::string& line) {
    if (socket_ < 0 && !refused_) socket_ = connect_to_control(control_socket_path(client_));
    if (socket_ < 0) {
        if (!refused_) std::fputs("foveray-simulator-window: the headset takes no commands\n", stderr);
        refused_ = true;
        return;
    }
    char replies[4096];
    while (recv(socket_, replies, sizeof replies, MSG_DONTWAIT) > 0) {
    }
    const std::string text = line + "\n";
    ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
}

}  // namespace foveray::simulator
